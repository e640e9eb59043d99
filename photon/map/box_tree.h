#pragma once
// Tree of boxes over photons in Morton order, which searches descend: blocks of sixteen consecutive photons,
// and nodes of sixteen boxes that SIMD lanes test at once. Only boxes are stored, since the index of a node
// determines its children. Takes 1.9 bytes per photon.

#include <span>
#include <vector>

#include "core/memory/shared_array.h"
#include "photon/map/octree.h"
#include "photon/record/photon_columns.h"

namespace kaustik::photon {

// Boxes in metres; at the lowest level around the photons of each block. Empty boxes have lo > hi.
struct alignas(64) BoxNode {
  static constexpr uint32_t kBoxes = 16;
  float lo[3][kBoxes], hi[3][kBoxes];
};

class BoxTree {
 public:
  static constexpr uint32_t kBlockPhotons = 16, kNodePhotons = kBlockPhotons * BoxNode::kBoxes;

  // What the photons of a block have in common: their packed surface if it is the same for all; otherwise
  // their surface group combined with kAnyNormal; otherwise kAnySurface. Neither constant is a valid packed
  // surface.
  static constexpr uint32_t kAnyNormal = 0xffff, kAnySurface = 0xffffffff;
  struct alignas(64) Surfaces {
    uint32_t of_block[BoxNode::kBoxes];
  };

  BoxTree() = default;
  // Builds the tree over the first `size` photons, fewer than 2^32. The result does not depend on the number
  // of threads.
  BoxTree(const PhotonColumns& columns, uint64_t size);
  // The tree over `size` photons that has these boxes and surfaces. Throws std::invalid_argument for another
  // number of them.
  BoxTree(uint64_t size, SharedArray<BoxNode> nodes, SharedArray<Surfaces> surfaces);

  // Box b of node i encloses node 16 i + b of the level below, or at level 0 block 16 i + b. The last level
  // has one node; there are no levels if there are no photons.
  int levels() const { return levels_; }
  std::span<const BoxNode> level(int l) const {
    return {nodes_.data() + first_[l], first_[l + 1] - first_[l]};
  }

  // Nodes of one level, in ascending order, at which a search begins.
  struct Start {
    static constexpr size_t kMost = 32;
    int level = 0;
    size_t size = 0;
    uint32_t nodes[kMost + 2];  // with room for branchless writes behind the last

    // Lists the nodes of 2^shift photons that the ranges overlap; false when there are more than kMost.
    bool list(const CellRanges& ranges, int shift);
  };
  // Nodes that hold the photons of the ranges, at the lowest level at which there are at most Start::kMost.
  Start start_at(const CellRanges& ranges) const;

  const SharedArray<Surfaces>& surfaces() const { return surfaces_; }  // one per node of the lowest level
  const SharedArray<BoxNode>& nodes() const { return nodes_; }         // level by level

  uint64_t memory_bytes() const { return nodes_.bytes() + surfaces_.bytes(); }

 private:
  static constexpr int kMostLevels = 7;  // 16^8 photons

  void set_levels(uint64_t size);

  SharedArray<BoxNode> nodes_;
  SharedArray<Surfaces> surfaces_;
  uint64_t first_[kMostLevels + 1] = {};
  int levels_ = 0;
};

}  // namespace kaustik::photon
