// Tests the photon map and its rivals in the benchmarks against brute force: they accept the same photons and
// their sums agree, so the benchmarks compare equal work.

#include "benchmarks/photon_index.h"

#include <gtest/gtest.h>

#include <map>

#include "benchmarks/rivals/dense_grid.h"
#include "benchmarks/rivals/hash_grid.h"
#include "benchmarks/rivals/kd_tree.h"
#include "benchmarks/rivals/photon_map_index.h"
#include "benchmarks/rivals/pointer_octree.h"
#include "photon/record/packing.h"
#include "tests/photon/support/photon_sets.h"

namespace kaustik::benchmarks {
namespace {

using photon::GatherCounters;
using photon::GatherQuery;
using photon::PhotonBuffer;
using photon::PhotonRecord;
using photon::PhotonSet;

// Whether a photon counts, by the definition.
bool counts(const PhotonRecord& record, const GatherQuery& q) {
  const Vector3 d = Point3(record.x, record.y, record.z) - q.p;
  return d.x * d.x + d.y * d.y + d.z * d.z <= q.radius * q.radius &&
         record.surface >> 16 == (q.surface_group & 0xffff) && photon::normal_counts(record.surface, q.n);
}

// Encodes a number below 2^27 as a flux that RGB9E5 holds exactly: nine bits in each channel, with the
// exponent at which the mantissas are integers.
uint32_t power_of_id(uint32_t id) {
  return id | 24u << 27;
}
uint32_t id_of_flux(const Rgb& flux) {
  return uint32_t(flux.x) | uint32_t(flux.y) << 9 | uint32_t(flux.z) << 18;
}

PhotonBuffer numbered(const PhotonSet& set) {
  PhotonBuffer buffer = photon::make_buffer(set.photons);
  for (uint32_t i = 0; i < buffer.records.size(); ++i) buffer.records[i].power = power_of_id(i);
  return buffer;
}

// Queries by radius, since an index is built for one radius. An infinite radius reaches everything.
std::map<float, std::vector<GatherQuery>> queries_by_radius(const PhotonSet& set) {
  std::map<float, std::vector<GatherQuery>> queries;
  for (const GatherQuery& query : photon::queries_for(set, 240)) queries[query.radius].push_back(query);
  for (GatherQuery query : photon::queries_for(set, 6)) {
    query.radius = kInfinity;
    queries[kInfinity].push_back(query);
  }
  return queries;
}

template <class Index>
class PhotonIndices : public testing::Test {};

struct IndexName {
  template <class Index>
  static std::string GetName(int) {
    std::string name(Index::kName);
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
  }
};
using Indices = testing::Types<PhotonMapIndex, KdTree, HashGrid, PointerOctree, DenseGrid>;
TYPED_TEST_SUITE(PhotonIndices, Indices, IndexName);

TYPED_TEST(PhotonIndices, AcceptThePhotonsOfBruteForceEachOnce) {
  for (const PhotonSet& set : photon::photon_sets()) {
    const PhotonBuffer buffer = numbered(set);
    for (const auto& [radius, queries] : queries_by_radius(set)) {
      const TypeParam index = TypeParam::build(PhotonBuffer(buffer), radius);
      for (const GatherQuery& query : queries) {
        std::vector<uint32_t> found, expected;
        GatherCounters counters;
        index.for_each(query, counters, [&](const Rgb& flux) { found.push_back(id_of_flux(flux)); });
        std::sort(found.begin(), found.end());
        for (uint32_t i = 0; i < buffer.records.size(); ++i) {
          if (counts(buffer.records[i], query)) expected.push_back(i);
        }
        ASSERT_EQ(found, expected) << set.name << ", radius " << radius;
        ASSERT_EQ(counters.accepted, expected.size());
        ASSERT_GE(counters.candidates, counters.accepted);
        ASSERT_EQ(counters.queries, 1u);
      }
    }
  }
}

TYPED_TEST(PhotonIndices, SumTheFluxOfBruteForce) {
  for (const PhotonSet& set : photon::photon_sets()) {
    const PhotonBuffer buffer = photon::make_buffer(set.photons, 0x1p-3f);
    for (const auto& [radius, queries] : queries_by_radius(set)) {
      const TypeParam index = TypeParam::build(PhotonBuffer(buffer), radius);
      for (const GatherQuery& query : queries) {
        glm::dvec3 expected(0);
        uint64_t accepted = 0;
        for (const PhotonRecord& record : buffer.records) {
          if (!counts(record, query)) continue;
          ++accepted;
          expected += glm::dvec3(photon::unpack(record, buffer.flux_unit).flux);
        }
        const bool area = radius > 0 && std::isfinite(radius);
        expected *= area ? 1 / (std::numbers::pi * double(radius) * double(radius)) : 0;
        GatherCounters counters;
        const Rgb density = index.flux_density(query, counters);
        ASSERT_EQ(counters.accepted, accepted) << set.name << ", radius " << radius;
        // All terms are positive, so each rounding is off by at most half an epsilon of the sum: at most 1024
        // float additions, and fewer than 16 roundings of a term, of pi, of the area, its inverse and the
        // product.
        const double rounding = (1024 + 16) * double(std::numeric_limits<float>::epsilon()) / 2;
        for (int c = 0; c < 3; ++c) {
          ASSERT_NEAR(density[c], expected[c], rounding * expected[c]) << set.name << ", radius " << radius;
        }
      }
    }
  }
}

TEST(KdTree, NearestRadiusMatchesThePhotonMap) {
  for (const PhotonSet& set : photon::photon_sets()) {
    const PhotonBuffer buffer = photon::make_buffer(set.photons);
    const PhotonMapIndex map = PhotonMapIndex::build(PhotonBuffer(buffer), 0);
    const KdTree tree = KdTree::build(PhotonBuffer(buffer), 0);
    for (const GatherQuery& query : photon::queries_for(set, 60)) {
      for (const uint32_t k : {1u, 50u}) {
        GatherCounters counters;
        const float radius = tree.nearest_radius(query, k, counters);
        // nanoflann rounds the root and the squared distance differently: a few units in the last place.
        ASSERT_NEAR(map.nearest_radius(query, k, counters), radius, 1e-6f * radius) << set.name;
      }
    }
  }
}

// Grids built for one radius also answer queries with smaller radii.
TYPED_TEST(PhotonIndices, AnswerSmallerRadiiThanThatOfTheBuild) {
  const std::vector<PhotonSet> sets = photon::photon_sets();
  const auto walls =
      std::find_if(sets.begin(), sets.end(), [](const PhotonSet& set) { return set.name == "walls"; });
  const PhotonBuffer buffer = numbered(*walls);
  const TypeParam index = TypeParam::build(PhotonBuffer(buffer), 0.5f);
  for (GatherQuery query : photon::queries_for(*walls, 60)) {
    query.radius = std::min(query.radius, 0.5f);
    size_t found = 0, expected = 0;
    GatherCounters counters;
    index.for_each(query, counters, [&](const Rgb&) { ++found; });
    for (const PhotonRecord& record : buffer.records) expected += counts(record, query);
    ASSERT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace kaustik::benchmarks
