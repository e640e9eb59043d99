#include "photon/map/octree.h"

#include <gtest/gtest.h>

#include "photon/gather/gather.h"
#include "tests/photon/support/photon_sets.h"

namespace kaustik::photon {
namespace {

uint64_t key_of(const PhotonMap& map, uint64_t i) {
  return morton_key(map.cube().cell(map.photon(i).p));
}
uint64_t cell_prefix(uint64_t key, int depth) {
  return depth == 0 ? 0 : key >> (3 * (kMortonBits - depth));
}

// The photons of the cell of depth `depth` around the key, found one by one.
PhotonRange brute_force_cell(const PhotonMap& map, uint64_t key, int depth) {
  PhotonRange range{map.size(), map.size()};
  for (uint64_t i = map.size(); i-- > 0;) {
    if (cell_prefix(key_of(map, i), depth) != cell_prefix(key, depth)) continue;
    if (range.empty()) range.end = i + 1;
    range.begin = i;
  }
  return range;
}

void check_node(const PhotonMap& map, const OctreeNode& node, int depth, size_t& visited) {
  const std::span<const OctreeNode> nodes = map.octree().nodes();
  ++visited;
  ASSERT_LT(node.begin, node.end);
  ASSERT_EQ(cell_prefix(key_of(map, node.begin), depth), cell_prefix(key_of(map, node.end - 1), depth));
  if (node.leaf()) {
    EXPECT_TRUE(node.range().size() <= Octree::kLeafPhotons || depth == kMortonBits);
    return;
  }
  EXPECT_GT(node.range().size(), Octree::kLeafPhotons);
  uint32_t next = node.begin;
  for (uint32_t octant = 0; octant < 8; ++octant) {
    if (!node.has_child(octant)) continue;
    const OctreeNode& child = nodes[node.child(octant)];
    EXPECT_EQ(child.begin, next);
    EXPECT_EQ(morton_octant(key_of(map, child.begin), depth + 1), octant);
    next = child.end;
    check_node(map, child, depth + 1, visited);
  }
  EXPECT_EQ(next, node.end);
}

TEST(Octree, NodesPartitionThePhotons) {
  for (const PhotonSet& set : photon_sets()) {
    SCOPED_TRACE(set.name);
    const PhotonMap map = PhotonMap::build(make_buffer(set.photons));
    size_t visited = 0;
    if (!map.empty()) check_node(map, map.octree().nodes()[0], 0, visited);
    EXPECT_EQ(visited, map.octree().nodes().size());
  }
}

// More photons than one subtree holds, at all depths: evenly spread, in one point, and around one point with
// rising density.
TEST(Octree, LargeTreesPartitionThePhotons) {
  PhotonMaker make(21);
  const Normal3 up(0, 0, 1);
  for (const int count : {32768, 32769, 150000}) {
    std::vector<Photon> even, point, funnel;
    for (int i = 0; i < count; ++i) {
      even.push_back(make.on_wall());
      point.push_back(make.at(i % 4 == 0 ? 2.0f * make.direction() : Point3(0.5f), up, 0));
      funnel.push_back(make.at(std::exp2(-30 * make.uniform()) * make.direction(), up, 0));
    }
    for (const std::vector<Photon>& photons : {even, point, funnel}) {
      const PhotonMap map = PhotonMap::build(make_buffer(photons));
      size_t visited = 0;
      check_node(map, map.octree().nodes()[0], 0, visited);
      EXPECT_EQ(visited, map.octree().nodes().size());
    }
  }
}

TEST(Octree, DescendMatchesBruteForce) {
  for (const PhotonSet& set : photon_sets()) {
    if (set.photons.size() > 5000) continue;
    SCOPED_TRACE(set.name);
    const PhotonMap map = PhotonMap::build(make_buffer(set.photons));
    for (const GatherQuery& query : queries_for(set, 12)) {
      const uint64_t key = morton_key(map.cube().cell(query.p));
      PhotonRange ranges[kMortonBits + 1];
      ASSERT_EQ(map.octree().descend(map.positions(), key, ranges, [](int, PhotonRange) { return false; }),
                kMortonBits);
      for (int depth = 0; depth <= kMortonBits; ++depth) {
        const PhotonRange expected = brute_force_cell(map, key, depth);
        ASSERT_EQ(ranges[depth].size(), expected.size()) << depth;
        ASSERT_TRUE(expected.empty() || ranges[depth].begin == expected.begin) << depth;
      }
    }
  }
}

// Checks the lecture's stopping rules by their definition.
TEST(Octree, FindCellObeysTheStoppingRules) {
  for (const PhotonSet& set : photon_sets()) {
    if (set.photons.size() > 5000) continue;
    SCOPED_TRACE(set.name);
    const PhotonMap map = PhotonMap::build(make_buffer(set.photons));
    const Octree& octree = map.octree();
    for (const GatherQuery& query : queries_for(set, 60)) {
      const uint64_t key = morton_key(map.cube().cell(query.p));
      const uint32_t n0 = 20;
      const OctreeCell cell = map.find_cell(query.p, n0, query.radius);
      const int leaf = cell.depth + cell.climbed;
      EXPECT_TRUE(brute_force_cell(map, key, leaf).size() <= n0 || !octree.children_hold(query.radius, leaf));
      if (leaf > 0) {
        EXPECT_GT(brute_force_cell(map, key, leaf - 1).size(), n0);
        EXPECT_GE(std::ldexp(map.cube().size, -leaf), 2 * query.radius);
      }
      EXPECT_TRUE(cell.depth == 0 || octree.keeps_from_faces(query.p, query.radius, cell.depth));
      for (int depth = cell.depth + 1; depth <= leaf; ++depth) {
        EXPECT_FALSE(octree.keeps_from_faces(query.p, query.radius, depth));
      }
      EXPECT_EQ(cell.range.size(), brute_force_cell(map, key, cell.depth).size());
    }
  }
}

// Where p is at least the radius away from the faces, the cell contains the whole sphere.
TEST(Octree, CellContainsEveryPhotonInReach) {
  PhotonMaker make(14);
  std::vector<Photon> photons;
  for (int i = 0; i < 20000; ++i) photons.push_back(make.on_wall());
  const PhotonMap map = PhotonMap::build(make_buffer(photons));
  uint64_t climbed = 0, stayed = 0;
  for (GatherQuery query : queries_for({"walls", photons}, 400)) {
    query.radius = 0.1f;
    GatherCounters counters;
    const Rgb exact = gather_flux(map, query, {}, counters);
    const OctreeCell cell = map.find_cell(query.p, 64, query.radius);
    query.within = cell.range;
    GatherCounters in_cell;
    gather_flux(map, query, {}, in_cell);
    EXPECT_EQ(in_cell.accepted, counters.accepted) << exact.x;
    ++(cell.climbed ? climbed : stayed);
  }
  EXPECT_GT(climbed, 0u);
  EXPECT_GT(stayed, 0u);
}

TEST(Octree, CellBoundsContainThePoint) {
  const PhotonSet walls = photon_sets()[8];
  const PhotonMap map = PhotonMap::build(make_buffer(walls.photons));
  for (const Photon& photon : walls.photons) {
    const OctreeCell cell = map.find_cell(photon.p, 32, 0.05f);
    const Bounds3& b = cell.bounds;
    ASSERT_EQ(glm::min(b.min, photon.p), b.min);
    ASSERT_EQ(glm::max(b.max, photon.p), b.max);
  }
}

}  // namespace
}  // namespace kaustik::photon
