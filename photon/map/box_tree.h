#pragma once
// A tree of boxes over photons in Morton order, which the searches go down: blocks of sixteen neighbours, and
// nodes of sixteen boxes that SIMD lanes test at once. Nothing but boxes is stored: a node's place tells its
// children. 1.9 bytes per photon.

#include <span>
#include <vector>

#include "core/memory/uninitialised_array.h"
#include "photon/gather/gather.h"
#include "photon/map/octree.h"

namespace kaustik::photon {

// Metres; of the lowest level, around the photons of each block. lo above hi where there are none.
struct alignas(64) BoxNode {
  static constexpr uint32_t kBoxes = 16;
  float lo[3][kBoxes], hi[3][kBoxes];
};

class BoxTree {
 public:
  static constexpr uint32_t kBlockPhotons = 16, kNodePhotons = kBlockPhotons * BoxNode::kBoxes;

  BoxTree() = default;
  // Of the first `size` photons, fewer than 2^32. The result does not depend on the number of threads.
  BoxTree(const PhotonColumns& columns, uint64_t size);

  // Box b of node i is around node 16 i + b of the level before, or at level 0 around block 16 i + b. The
  // last level has one node; there is no level when there is no photon.
  int levels() const { return levels_; }
  std::span<const BoxNode> level(int l) const {
    return {nodes_.data() + first_[l], first_[l + 1] - first_[l]};
  }

  // Nodes of one level, ascending, that a search begins with.
  struct Start {
    static constexpr size_t kMost = 32;
    int level = 0;
    size_t size = 0;
    uint32_t nodes[kMost + 2];  // and room behind them

    // The nodes of 2^shift photons that the ranges meet; false when they are too many.
    bool list(const CellRanges& ranges, int shift);
  };
  // Those that hold the photons of the ranges: of the lowest level at which they are few.
  Start start_at(const CellRanges& ranges) const;

  // What the photons of a block have in common: their packed surface; or, where that differs, their surface
  // group with kAnyNormal; or kAnySurface. Neither is a packed surface.
  static constexpr uint32_t kAnyNormal = 0xffff, kAnySurface = 0xffffffff;
  struct alignas(64) Surfaces {
    uint32_t of_block[BoxNode::kBoxes];
  };
  std::span<const Surfaces> surfaces() const { return {surfaces_.data(), surfaces_.size()}; }

  uint64_t memory_bytes() const {
    return nodes_.size() * sizeof(BoxNode) + surfaces_.size() * sizeof(Surfaces);
  }

 private:
  static constexpr int kMostLevels = 7;  // 16^8 photons

  UninitialisedArray<BoxNode> nodes_;      // level by level
  UninitialisedArray<Surfaces> surfaces_;  // by node of the lowest level
  uint64_t first_[kMostLevels + 1] = {};
  int levels_ = 0;
};

inline BoxTree::Start start_of(const IndexedPhotons& photons, const GatherQuery& query) {
  return photons.tree->start_at(photons.octree->ranges_near(query.p, query.radius, query.within));
}

}  // namespace kaustik::photon
