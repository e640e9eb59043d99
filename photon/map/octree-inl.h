#pragma once
// Octree::descend(). Included by octree.h only.

#include "photon/map/octree.h"

namespace kaustik::photon {

template <class Stop>
int Octree::descend(const PhotonPositions& positions, uint64_t key, PhotonRange (&ranges)[kMortonBits + 1],
                    Stop&& stop) const {
  const OctreeNode* node = nodes_.empty() ? nullptr : nodes_.data();
  ranges[0] = {0, size_};
  int depth = 0;
  while (depth < kMortonBits && !stop(depth, ranges[depth])) {
    const PhotonRange parent = ranges[depth++];
    const uint32_t octant = morton_octant(key, depth);
    if (node == nullptr || node->leaf()) {  // below the stored nodes
      ranges[depth] = child_range(positions, parent, key, depth);
    } else if (node->has_child(octant)) {
      node = &nodes_[node->child(octant)];
      ranges[depth] = node->range();
    } else {
      ranges[depth] = {parent.end, parent.end};
      node = nullptr;
    }
  }
  return depth;
}

}  // namespace kaustik::photon
