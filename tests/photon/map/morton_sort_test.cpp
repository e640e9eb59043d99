#include "photon/map/morton_sort.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <random>
#include <string>

namespace kaustik::photon {
namespace {

using Records = PhotonRecords;

const MortonCube kCube = MortonCube::around({Point3(0), Point3(1)});

uint64_t key_of(const PhotonRecord& r) {
  return morton_key(kCube.cell({r.x, r.y, r.z}));
}

// The direction tells where each record was.
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

class Points {
 public:
  float uniform() { return float(random_() >> 8) * 0x1p-24f; }
  Point3 in_cube() { return {uniform(), uniform(), uniform()}; }

 private:
  std::mt19937 random_{3};
};

// Sizes on both sides of one bucket and two (32768), of one block and two (65536), and with several of both.
constexpr size_t kSizes[] = {0, 1, 2, 3, 32767, 32768, 65535, 65536, 65537, 131073, 400000};

TEST(MortonSort, AgreesWithAStableSort) {
  Points make;
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  const Point3 odd[] = {Point3(nan), Point3(infinity), Point3(-infinity), {nan, 0.5f, 0.5f}, Point3(1e30f)};
  for (const size_t size : kSizes) {
    check("volume", make_records(size, [&](size_t) { return make.in_cube(); }));
    check("surface", make_records(size, [&](size_t) { return make.in_cube() * Vector3(1, 1, 0); }));
    check("one key", make_records(size, [&](size_t) { return Point3(0.3f); }));
    check("two keys", make_records(size, [&](size_t i) { return Point3(i & 1 ? 0.3f : 0.7f); }));
    check("coarse", make_records(size, [&](size_t) { return glm::floor(8.0f * make.in_cube()) / 8.0f; }));
    // All but a few within 1/1000 of the cube: one prefix of the keys holds all the buckets.
    check("cluster", make_records(size, [&](size_t i) {
            return i % 1000 == 0 ? make.in_cube() : Point3(0.6f) + 1e-3f * make.in_cube();
          }));
    check("a frequent key",
          make_records(size, [&](size_t i) { return i % 3 == 0 ? make.in_cube() : Point3(0.6f); }));
    check("odd", make_records(size, [&](size_t i) { return i % 7 == 0 ? odd[i % 5] : make.in_cube(); }));
  }
}

TEST(MortonSort, TakesWhatIsSortedOrReversed) {
  Points make;
  Records records = sorted(make_records(200000, [&](size_t) { return make.in_cube(); }));
  check("sorted", records);
  std::ranges::reverse(records);
  check("reversed", records);
}

TEST(MortonSort, DoesNotDependOnTheThreads) {
  Points make;
  const Records records = make_records(
      300000, [&](size_t i) { return i % 5 == 0 ? Point3(0.25f) : make.in_cube() * Vector3(1, 1, 0.01f); });
  const Records one = sorted(records);
  for (const size_t threads : {1, 2, 3, 8}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_TRUE(same(sorted(records), one)) << threads << " threads";
  }
}

}  // namespace
}  // namespace kaustik::photon
