// Tests the photon map against brute force, on random and degenerate sets of photons.

#include "photon/map/photon_map.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cstring>

#include "photon/gather/gather.h"
#include "photon/gather/nearest.h"
#include "photon/record/packing.h"
#include "tests/photon/support/photon_sets.h"
#include "tests/support/packed_flux.h"

namespace kaustik::photon {
namespace {

float distance_squared(const Point3& a, const Point3& b) {
  const Vector3 d = a - b;
  return d.x * d.x + d.y * d.y + d.z * d.z;
}

// Whether a stored (packed) photon counts, by the definition.
bool counts(const PhotonMap& map, uint64_t i, const GatherQuery& q) {
  const uint32_t surface = map.columns().surface[i];
  return distance_squared(map.photon(i).p, q.p) <= q.radius * q.radius &&
         surface >> 16 == (q.surface_group & 0xffff) && normal_counts(surface, q.n);
}

struct BruteForce {
  std::vector<float> distances;  // squared distances in Morton order
  glm::dvec3 sum{0};             // flux times kernel
};

BruteForce brute_force(const PhotonMap& map, const GatherQuery& q, const KernelSpec& kernel) {
  BruteForce result;
  const KernelTerms terms = kernel_terms(kernel, q.radius);
  for (uint64_t i = 0; i < map.size(); ++i) {
    if (!counts(map, i, q)) continue;
    const float d2 = distance_squared(map.photon(i).p, q.p);
    result.distances.push_back(d2);
    result.sum += glm::dvec3(map.photon(i).flux) * double(kernel_value(kernel.type, terms, d2));
  }
  return result;
}

class PhotonMapSets : public testing::TestWithParam<PhotonSet> {
 protected:
  PhotonMap map_ = PhotonMap::build(make_buffer(GetParam().photons));
  std::vector<GatherQuery> queries_ = queries_for(GetParam(), 240);
};

TEST_P(PhotonMapSets, ForEachFindsWhatBruteForceFinds) {
  GatherCounters counters;
  uint64_t found_in_all = 0;
  for (const GatherQuery& query : queries_) {
    std::vector<float> found;
    for_each_photon(
        map_, query, [&](const Photon&, float d2) { found.push_back(d2); }, counters);
    ASSERT_EQ(found, brute_force(map_, query, {}).distances) << "radius " << query.radius;
    found_in_all += found.size();
  }
  EXPECT_EQ(counters.accepted, found_in_all);
  EXPECT_EQ(counters.queries, queries_.size());
  EXPECT_GE(counters.candidates, counters.accepted);
  EXPECT_EQ(found_in_all > 0, !GetParam().photons.empty());
}

TEST_P(PhotonMapSets, GatherSumsWhatBruteForceSums) {
  for (const KernelType type : kKernelTypes) {
    const KernelSpec kernel{type, 1.25f};
    for (const GatherQuery& query : queries_) {
      GatherCounters counters;
      const Rgb sum = gather_flux(map_, query, kernel, counters);
      const BruteForce expected = brute_force(map_, query, kernel);
      ASSERT_EQ(counters.accepted, expected.distances.size());
      // All terms are positive. A lane adds at most 1024 terms before it moves the sum to double; each term
      // and each sum is rounded once. A weight carries a few roundings of numbers up to one, an absolute
      // error, so the bound is relative to the sum with the weight at its largest.
      const KernelTerms terms = kernel_terms(kernel, query.radius);
      const double rounding = (1024 + 16) * double(std::numeric_limits<float>::epsilon()) / 2;
      const double bound = rounding * double(terms.scale) * double(expected.distances.size());
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(sum[c], expected.sum[c], bound) << "radius " << query.radius;
    }
  }
}

TEST_P(PhotonMapSets, NearestRadiusMatchesBruteForce) {
  GatherCounters counters;
  for (const GatherQuery& query : queries_) {
    BruteForce all = brute_force(map_, query, {});
    std::sort(all.distances.begin(), all.distances.end());
    for (const uint32_t k : {1u, 3u, 50u, 5000u}) {
      const float radius = nearest_radius(map_, query, k, counters);
      if (all.distances.size() < k) {
        ASSERT_EQ(radius, query.radius);
        continue;
      }
      // The radius is the smallest float whose square reaches the k-th photon, up to the rounding of the
      // root.
      const float d2 = all.distances[k - 1];
      ASSERT_GE(radius * radius, d2);
      ASSERT_LE(radius, std::min(query.radius, std::nextafter(std::sqrt(d2), kInfinity)));
      GatherQuery smaller = query;
      smaller.radius = radius;
      ASSERT_GE(brute_force(map_, smaller, {}).distances.size(), k);
    }
  }
}

TEST_P(PhotonMapSets, WithinLimitsTheSearchToARange) {
  const PhotonRange within{map_.size() / 3, map_.size() - map_.size() / 4};
  GatherCounters counters;
  for (GatherQuery query : queries_) {
    query.within = within;
    uint64_t expected = 0, found = 0;
    for (uint64_t i = within.begin; i < within.end; ++i) expected += counts(map_, i, query);
    for_each_photon(
        map_, query, [&](const Photon&, float) { ++found; }, counters);
    ASSERT_EQ(found, expected);
  }
}

TEST_P(PhotonMapSets, PhotonsAreThoseOfTheBufferInKeyOrder) {
  PhotonRecords records = make_buffer(GetParam().photons).records;
  const MortonCube cube = map_.cube();
  std::stable_sort(records.begin(), records.end(), [&](const PhotonRecord& a, const PhotonRecord& b) {
    return morton_key(cube.cell({a.x, a.y, a.z})) < morton_key(cube.cell({b.x, b.y, b.z}));
  });
  ASSERT_EQ(map_.size(), records.size());
  const PhotonColumns& c = map_.columns();
  for (uint64_t i = 0; i < map_.size(); ++i) {
    const PhotonRecord stored{c.x[i], c.y[i], c.z[i], c.direction[i], c.power[i], c.surface[i]};
    ASSERT_EQ(std::memcmp(&stored, &records[i], sizeof(stored)), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, PhotonMapSets, testing::ValuesIn(photon_sets()));

std::vector<Photon> wall_photons(int count) {
  PhotonMaker make(5);
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) photons.push_back(make.on_wall());
  return photons;
}

// Everything that a map stores, as bytes.
std::vector<uint32_t> contents(const PhotonMap& map) {
  std::vector<uint32_t> words;
  const auto add = [&](const void* from, size_t bytes) {
    const size_t at = words.size();
    words.resize(at + bytes / sizeof(uint32_t));
    std::memcpy(words.data() + at, from, bytes);
  };
  const PhotonColumns& c = map.columns();
  const size_t column = map.size() * sizeof(uint32_t);
  for (const void* data : {static_cast<const void*>(c.x), static_cast<const void*>(c.y),
                           static_cast<const void*>(c.z), static_cast<const void*>(c.direction),
                           static_cast<const void*>(c.surface), static_cast<const void*>(c.power)}) {
    add(data, column);
  }
  add(map.octree().nodes().data(), map.octree().nodes().bytes());
  add(map.boxes().level(0).data(), map.boxes().level(0).size_bytes());
  return words;
}

TEST(PhotonMap, HasTheSameBytesForAnyNumberOfThreads) {
  const std::vector<Photon> photons = wall_photons(400000);
  std::vector<uint32_t> one_thread;
  for (const size_t threads : {1u, 2u, 3u, 8u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const std::vector<uint32_t> bytes = contents(PhotonMap::build(make_buffer(photons)));
    if (threads == 1)
      one_thread = bytes;
    else
      EXPECT_TRUE(bytes == one_thread) << threads << " threads";
  }
}

// Copies of a map's arrays, to be changed and put together again.
struct ChangedParts {
  explicit ChangedParts(const PhotonMap& map)
      : parts(map.parts()),
        nodes(parts.nodes.begin(), parts.nodes.end()),
        entries(parts.entries.begin(), parts.entries.end()) {}
  PhotonMap map() {
    parts.nodes = SharedArray<OctreeNode>(nodes, nullptr);
    parts.entries = SharedArray<uint32_t>(entries, nullptr);
    return PhotonMap(parts);
  }
  PhotonMapParts parts;
  std::vector<OctreeNode> nodes;
  std::vector<uint32_t> entries;
};

TEST(PhotonMap, IsThatOfItsParts) {
  for (const int size : {0, 1, 300, 20000}) {
    const PhotonMap map = PhotonMap::build(make_buffer(wall_photons(size)), {Bounds3({0, 0, 0}, {4, 3, 2})});
    ChangedParts parts(map);
    const PhotonMap again = parts.map();
    EXPECT_EQ(again.size(), map.size());
    EXPECT_EQ(again.cube(), map.cube());
    EXPECT_EQ(again.memory_bytes(), map.memory_bytes());
    GatherCounters counters, counters_again;
    for (const GatherQuery& query : queries_for({"walls", wall_photons(size)}, 100)) {
      const KernelSpec kernel{KernelType::kCone, 1.5f};
      EXPECT_EQ(gather_flux(again, query, kernel, counters_again), gather_flux(map, query, kernel, counters));
    }
    EXPECT_EQ(counters_again.candidates, counters.candidates);
  }
}

// Each change would let a search read beyond the arrays, or never end.
TEST(PhotonMap, RefusesPartsThatASearchWouldLeave) {
  const PhotonMap map = PhotonMap::build(make_buffer(wall_photons(20000)));
  const auto refuses = [&](const auto& change) {
    ChangedParts changed(map);
    change(changed);
    EXPECT_THROW(changed.map(), std::invalid_argument);
  };
  const auto last_node = map.octree().nodes().size() - 1;
  refuses([](ChangedParts& c) { c.nodes[0].first_child = 0; });
  refuses([&](ChangedParts& c) { c.nodes[0].first_child = uint32_t(last_node); });
  refuses([](ChangedParts& c) { c.nodes[0].first_child = ~0u; });
  refuses([&](ChangedParts& c) { c.nodes[last_node].end = 20001; });
  refuses([&](ChangedParts& c) { c.nodes[last_node].begin = c.nodes[last_node].end; });
  refuses([](ChangedParts& c) { c.nodes.clear(); });
  refuses([](ChangedParts& c) { c.entries.back() = 20001; });
  refuses([](ChangedParts& c) { c.entries[1] = 20001; });
  refuses([](ChangedParts& c) { c.entries.pop_back(); });
  refuses([](ChangedParts& c) { c.parts.size = 10000; });
  refuses([](ChangedParts& c) { c.parts.boxes = {}; });
  refuses([](ChangedParts& c) { c.parts.surfaces = {}; });
  refuses([](ChangedParts& c) { c.parts.columns = {}; });
}

TEST(PhotonMap, ScalingByAPowerOfTwoScalesTheGatherExactly) {
  const std::vector<Photon> photons = wall_photons(20000);
  const PhotonMap map = PhotonMap::build(make_buffer(photons));
  for (const int exponent : {-20, -1, 3, 20}) {
    std::vector<Photon> scaled = photons;
    for (Photon& photon : scaled) photon.p *= std::ldexp(1.0f, exponent);
    const PhotonMap scaled_map = PhotonMap::build(make_buffer(scaled));
    ASSERT_TRUE(std::equal(map.octree().nodes().begin(), map.octree().nodes().end(),
                           scaled_map.octree().nodes().begin(), scaled_map.octree().nodes().end(),
                           [](const OctreeNode& a, const OctreeNode& b) {
                             return a.begin == b.begin && a.first_child == b.first_child;
                           }));
    GatherCounters counters;
    for (GatherQuery query : queries_for({"walls", photons}, 200)) {
      const KernelSpec kernel{KernelType::kCone, 1.5f};
      const Rgb sum = gather_flux(map, query, kernel, counters);
      query.p *= std::ldexp(1.0f, exponent);
      query.radius *= std::ldexp(1.0f, exponent);
      EXPECT_EQ(gather_flux(scaled_map, query, kernel, counters) * std::ldexp(1.0f, 2 * exponent), sum);
    }
  }
}

// The sum of the fluxes as they were before they were packed, over the photons that count.
glm::dvec3 exact_flux(const std::vector<Photon>& photons, const GatherQuery& q) {
  glm::dvec3 sum(0);
  for (const Photon& photon : photons) {
    const uint32_t surface = pack_surface(photon.n, photon.surface_group);
    if (distance_squared(photon.p, q.p) <= q.radius * q.radius &&
        surface >> 16 == (q.surface_group & 0xffff) && normal_counts(surface, q.n))
      sum += glm::dvec3(photon.flux);
  }
  return sum;
}

TEST(PhotonMap, PackedPowerAgreesWithExactFlux) {
  std::vector<Photon> photons = wall_photons(20000);
  const float flux_unit = 0x1p-10f;
  for (Photon& photon : photons) photon.flux *= flux_unit;
  const PhotonMap packed = PhotonMap::build(make_buffer(photons, flux_unit));
  for (const GatherQuery& query : queries_for({"walls", photons}, 200)) {
    if (!(query.radius > 0)) continue;
    GatherCounters counters;
    const glm::dvec3 exact = exact_flux(photons, query) / (double(kPi) * query.radius * query.radius);
    const Rgb found = gather_flux(packed, query, {}, counters);
    // Each photon is off by at most kPackedFluxError of its largest component, which is at most the sum of
    // all three. A lane adds at most 1024 terms in float, and a weight carries a few roundings.
    const double rounding = (1024 + 16) * double(std::numeric_limits<float>::epsilon()) / 2;
    const double bound = (exact.x + exact.y + exact.z) * (test::kPackedFluxError + rounding);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], exact[c], bound);
  }
}

TEST(PhotonMap, PhotonsOutsideTheGivenBoundsAreFound) {
  const PhotonSet set{"walls", wall_photons(5000)};
  MapSettings settings;
  settings.bounds = Bounds3{Point3(1, 1, 0.5f), Point3(2, 2, 1)};
  const PhotonMap map = PhotonMap::build(make_buffer(set.photons), settings);
  EXPECT_EQ(map.cube(), MortonCube::around(*settings.bounds));
  GatherCounters counters;
  for (const GatherQuery& query : queries_for(set, 240)) {
    std::vector<float> found;
    for_each_photon(
        map, query, [&](const Photon&, float d2) { found.push_back(d2); }, counters);
    ASSERT_EQ(found, brute_force(map, query, {}).distances);
    BruteForce all = brute_force(map, query, {});
    if (all.distances.size() < 5) continue;
    std::sort(all.distances.begin(), all.distances.end());
    ASSERT_NEAR(nearest_radius(map, query, 5, counters), std::sqrt(all.distances[4]),
                1e-6f * std::sqrt(all.distances[4]));
  }
}

TEST(PhotonMap, InfiniteRadiusFindsAllOfTheSurface) {
  for (const int size : {1000, 5001, 70001}) {
    const PhotonMap map = PhotonMap::build(make_buffer(wall_photons(size)));
    const GatherQuery query{{1, 1, 0}, {0, 0, 1}, 2, kInfinity, kAllPhotons};
    uint64_t found = 0, expected = 0;
    GatherCounters counters;
    for_each_photon(
        map, query, [&](const Photon&, float) { ++found; }, counters);
    for (uint64_t i = 0; i < map.size(); ++i) expected += counts(map, i, query);
    EXPECT_EQ(found, expected);
    EXPECT_GT(found, 100u);
    EXPECT_LT(counters.candidates, map.size() + BoxTree::kBlockPhotons) << "no empty boxes";
    EXPECT_EQ(gather_flux(map, query, {}, counters), Rgb(0)) << "an infinite disc has no density";
  }
}

TEST(PhotonMap, IndexStaysSmallAgainstTheRecords) {
  const PhotonMap map = PhotonMap::build(make_buffer(wall_photons(200000)));
  EXPECT_LE(map.memory_bytes() - map.size() * sizeof(PhotonRecord), map.size() * sizeof(PhotonRecord) / 10);
}

}  // namespace
}  // namespace kaustik::photon
