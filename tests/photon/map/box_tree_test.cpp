// Tests that the boxes bound their photons, and that searches which begin with the octree's cells miss
// nothing.

#include "photon/map/box_tree.h"

#include <gtest/gtest.h>

#include <set>

#include "photon/gather/nearest.h"
#include "tests/photon/support/photon_sets.h"

namespace kaustik::photon {
namespace {

// The photons of a box of a level.
PhotonRange box_range(const PhotonMap& map, int level, uint64_t box) {
  const uint64_t photons = uint64_t(BoxTree::kBlockPhotons) << (4 * level);
  return {std::min(map.size(), box * photons), std::min(map.size(), (box + 1) * photons)};
}

TEST(BoxTree, BoxesAreTheBoundsOfTheirPhotons) {
  for (const PhotonSet& set : photon_sets()) {
    SCOPED_TRACE(set.name);
    const PhotonMap map = PhotonMap::build(make_buffer(set.photons));
    const BoxTree& boxes = map.boxes();
    ASSERT_EQ(boxes.levels() > 0, map.size() > 0);
    for (int level = 0; level < boxes.levels(); ++level) {
      ASSERT_EQ(boxes.level(level).size() == 1, level == boxes.levels() - 1);
      for (uint64_t box = 0; box < BoxNode::kBoxes * boxes.level(level).size(); ++box) {
        const PhotonRange range = box_range(map, level, box);
        Bounds3 bounds;
        for (uint64_t i = range.begin; i < range.end; ++i) bounds.add(map.photon(i).p);
        const BoxNode& node = boxes.level(level)[box / BoxNode::kBoxes];
        for (int axis = 0; axis < 3; ++axis) {
          const float lo = node.lo[axis][box % BoxNode::kBoxes], hi = node.hi[axis][box % BoxNode::kBoxes];
          if (range.empty()) {
            ASSERT_GT(lo, hi);
          } else {
            ASSERT_EQ(lo, bounds.min[axis]);
            ASSERT_EQ(hi, bounds.max[axis]);
          }
        }
      }
    }
  }
}

TEST(BoxTree, BlocksRecordWhatTheirSurfacesShare) {
  for (const PhotonSet& set : photon_sets()) {
    SCOPED_TRACE(set.name);
    const PhotonMap map = PhotonMap::build(make_buffer(set.photons));
    for (uint64_t block = 0; block * BoxTree::kBlockPhotons < map.size(); ++block) {
      const uint32_t common =
          map.boxes().surfaces()[block / BoxNode::kBoxes].of_block[block % BoxNode::kBoxes];
      const PhotonRange range = box_range(map, 0, block);
      bool one_surface = true, one_group = true;
      const uint32_t* const surface = map.columns().surface;
      for (uint64_t i = range.begin; i < range.end; ++i) {
        one_surface &= surface[i] == surface[range.begin];
        one_group &= surface[i] >> 16 == surface[range.begin] >> 16;
      }
      const uint32_t expected = one_surface ? surface[range.begin]
                                : one_group ? surface[range.begin] | BoxTree::kAnyNormal
                                            : BoxTree::kAnySurface;
      ASSERT_EQ(common, expected);
    }
  }
}

// Every photon of the range within the radius lies in one of the ranges, which ascend, and the start nodes
// contain all of them.
TEST(BoxTree, SearchesBeginWithAllPhotonsInReach) {
  for (const PhotonSet& set : photon_sets()) {
    SCOPED_TRACE(set.name);
    const PhotonMap map = PhotonMap::build(make_buffer(set.photons));
    const PhotonRange within{map.size() / 5, map.size() - map.size() / 7};
    for (const GatherQuery& query : queries_for(set, 60)) {
      const CellRanges ranges = map.octree().ranges_near(query.p, query.radius, within);
      for (size_t r = 0; r < ranges.size; ++r) {
        ASSERT_LE(ranges.first[r], ranges.last[r]);
        ASSERT_TRUE(r == 0 || ranges.last[r - 1] < ranges.first[r]);
      }
      const BoxTree::Start start = map.boxes().start_at(ranges);
      ASSERT_LE(start.size, BoxTree::Start::kMost);
      for (uint64_t i = within.begin; i < within.end; ++i) {
        if (glm::distance(map.photon(i).p, query.p) > query.radius) continue;
        const auto holds = [&](size_t r) { return ranges.first[r] <= i && i <= ranges.last[r]; };
        size_t holding = 0;
        for (size_t r = 0; r < ranges.size; ++r) holding += holds(r);
        ASSERT_EQ(holding, 1u);
        const uint32_t node = uint32_t(i / BoxTree::kNodePhotons >> (4 * start.level));
        ASSERT_TRUE(std::binary_search(start.nodes, start.nodes + start.size, node));
      }
    }
  }
}

// Compares with the distinct nodes of random ascending ranges, at the lowest level at which they are few.
TEST(BoxTree, StartContainsEachNodeOfTheRangesOnce) {
  PhotonMaker make(32);
  for (int round = 0; round < 2000; ++round) {
    CellRanges ranges;
    const float longest = std::exp2(20 * make.uniform());
    uint32_t next = uint32_t(1e6f * make.uniform());
    for (ranges.size = 0; ranges.size < size_t(round % 9); ++ranges.size) {
      ranges.first[ranges.size] = next + uint32_t(longest * make.uniform());
      ranges.last[ranges.size] = ranges.first[ranges.size] + uint32_t(longest * make.uniform());
      next = ranges.last[ranges.size] + 1;
    }
    const BoxTree::Start start = BoxTree().start_at(ranges);
    const auto nodes_at = [&](int level, size_t* listed) {
      std::set<uint32_t> nodes;
      for (size_t r = 0; r < ranges.size; ++r) {
        const uint32_t node_photons = BoxTree::kNodePhotons << (4 * level);
        for (uint32_t i = ranges.first[r] / node_photons; i <= ranges.last[r] / node_photons; ++i) {
          nodes.insert(i);
          ++*listed;
        }
      }
      return nodes;
    };
    size_t listed = 0, below = 0;
    const std::set<uint32_t> expected = nodes_at(start.level, &listed);
    ASSERT_TRUE(std::equal(expected.begin(), expected.end(), start.nodes, start.nodes + start.size));
    ASSERT_LE(listed, BoxTree::Start::kMost);
    if (start.level > 0) nodes_at(start.level - 1, &below);
    ASSERT_TRUE(start.level == 0 || below > BoxTree::Start::kMost);
  }
}

TEST(NearestSearch, DoesNotDependOnTheInitialRadius) {
  for (const PhotonSet& set : photon_sets()) {
    SCOPED_TRACE(set.name);
    const PhotonMap map = PhotonMap::build(make_buffer(set.photons));
    for (const GatherQuery& query : queries_for(set, 60)) {
      GatherCounters counters;
      const auto nearest = detail::nearest_distance_squared(map, query, 20, query.radius, counters);
      for (const float guess : {0.0f, 1e-9f, 0.01f, 1.0f, kInfinity})
        ASSERT_EQ(detail::nearest_distance_squared(map, query, 20, guess, counters), nearest) << guess;
    }
  }
}

// Random values, evenly and unevenly spread, with and without equal ones.
TEST(NearestSearch, SelectsTheKthSmallest) {
  PhotonMaker make(31);
  for (const size_t size : {1u, 2u, 16u, 31u, 32u, 33u, 100u, 1000u, 5000u}) {
    for (const float power : {0.0f, 0.1f, 1.0f, 20.0f}) {
      for (const float steps : {1.0f, 3.0f, 1e6f}) {
        std::vector<float> values(size + kSelectSlack);
        for (size_t i = 0; i < size; ++i)
          values[i] = std::pow(std::floor(make.uniform() * (steps + 1)) / (steps + 1), power);
        std::vector<float> sorted(values.begin(), values.begin() + long(size));
        std::sort(sorted.begin(), sorted.end());
        for (const size_t k : {size_t(1), size / 2 + 1, size}) {
          for (const float high : {1.0f, 7.0f, kInfinity}) {
            std::vector<float> copy = values;
            ASSERT_EQ(select_smallest(copy.data(), size, k, high), sorted[k - 1]) << size << " " << k;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace kaustik::photon
