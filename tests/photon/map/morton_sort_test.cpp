#include "photon/map/morton_sort.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>

#include "tests/support/random.h"

namespace kaustik::photon {
namespace {

using Records = PhotonRecords;

const MortonCube kCube = MortonCube::around({Point3(0), Point3(1)});

uint64_t key_of(const PhotonRecord& r) {
  return morton_key(kCube.cell({r.x, r.y, r.z}));
}

// The direction of each record encodes its original place.
template <class PointAt>
Records make_records(size_t size, const PointAt& point_at) {
  Records records(size);
  for (size_t i = 0; i < size; ++i) {
    const Point3 p = point_at(i);
    records[i] = {p.x, p.y, p.z, uint32_t(i), ~uint32_t(i), uint32_t(i * 2654435761u)};
  }
  return records;
}

Records sorted(Records records) {
  const size_t size = records.size();
  std::vector<float> floats(3 * size);
  std::vector<uint32_t> words(3 * size);
  sort_into_columns(records, kCube,
                    {floats.data(), floats.data() + size, floats.data() + 2 * size, words.data(),
                     words.data() + size, words.data() + 2 * size});
  for (size_t i = 0; i < size; ++i) {
    records[i] = {floats[i], floats[size + i], floats[2 * size + i],
                  words[i],  words[size + i],  words[2 * size + i]};
  }
  return records;
}

bool same(const Records& a, const Records& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
}

void check(const std::string& name, const Records& records) {
  Records expected = records;
  std::ranges::stable_sort(expected, {}, key_of);
  EXPECT_TRUE(same(sorted(records), expected)) << name << ", " << records.size() << " records";
}

// Sizes on both sides of one and two buckets (32768 records), of one and two blocks (65536 records), and with
// several of both.
constexpr size_t kSizes[] = {0, 1, 2, 3, 32767, 32768, 65535, 65536, 65537, 131073, 400000};

TEST(MortonSort, AgreesWithAStableSort) {
  test::Random random(3);
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  const Point3 odd[] = {Point3(nan), Point3(infinity), Point3(-infinity), {nan, 0.5f, 0.5f}, Point3(1e30f)};
  for (const size_t size : kSizes) {
    check("volume", make_records(size, [&](size_t) { return random.uniform_3d(); }));
    check("surface", make_records(size, [&](size_t) { return random.uniform_3d() * Vector3(1, 1, 0); }));
    check("one key", make_records(size, [&](size_t) { return Point3(0.3f); }));
    check("two keys", make_records(size, [&](size_t i) { return Point3(i & 1 ? 0.3f : 0.7f); }));
    check("coarse",
          make_records(size, [&](size_t) { return glm::floor(8.0f * random.uniform_3d()) / 8.0f; }));
    // All records but a few lie within 1/1000 of the cube: one prefix of the keys holds all the buckets.
    check("cluster", make_records(size, [&](size_t i) {
            return i % 1000 == 0 ? random.uniform_3d() : Point3(0.6f) + 1e-3f * random.uniform_3d();
          }));
    check("a frequent key",
          make_records(size, [&](size_t i) { return i % 3 == 0 ? random.uniform_3d() : Point3(0.6f); }));
    check("odd", make_records(size, [&](size_t i) { return i % 7 == 0 ? odd[i % 5] : random.uniform_3d(); }));
  }
}

TEST(MortonSort, SortsSortedAndReversedRecords) {
  test::Random random(3);
  Records records = sorted(make_records(200000, [&](size_t) { return random.uniform_3d(); }));
  check("sorted", records);
  std::ranges::reverse(records);
  check("reversed", records);
}

TEST(MortonSort, DoesNotDependOnTheThreads) {
  test::Random random(3);
  const Records records = make_records(300000, [&](size_t i) {
    return i % 5 == 0 ? Point3(0.25f) : random.uniform_3d() * Vector3(1, 1, 0.01f);
  });
  const Records one = sorted(records);
  for (const size_t threads : {1, 2, 3, 8}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_TRUE(same(sorted(records), one)) << threads << " threads";
  }
}

}  // namespace
}  // namespace kaustik::photon
