#pragma once
// Traversals of the octree. Included by octree.h only.

#include <algorithm>

#include "photon/octree.h"

namespace kaustik::photon {

namespace octree_detail {

// A level leaves at most seven siblings behind.
inline constexpr int kStackSize = 7 * kMortonBits + 2;

// Adjacent ranges leave as one.
template <class Fn>
struct RangeJoiner {
  Fn& fn;
  PhotonRange within;
  PhotonRange joined{};  // found, not yet reported

  void add(PhotonRange range) {
    range = {std::max(range.begin, within.begin), std::min(range.end, within.end)};
    if (range.empty()) return;
    if (range.begin != joined.end) {
      finish();
      joined.begin = range.begin;
    }
    joined.end = range.end;
  }
  void finish() {
    if (!joined.empty()) fn(joined);
  }
};

// Octants that are in the upper half of at least, or at most, the axes in a set.
template <bool kAtLeast>
constexpr std::array<uint8_t, 8> octant_sets() {
  std::array<uint8_t, 8> sets{};
  for (uint32_t axes = 0; axes < 8; ++axes) {
    for (uint32_t o = 0; o < 8; ++o) {
      if ((o & axes) == (kAtLeast ? axes : o)) sets[axes] = uint8_t(sets[axes] | 1u << o);
    }
  }
  return sets;
}
inline constexpr std::array<uint8_t, 8> kOctantsFrom = octant_sets<true>(),
                                        kOctantsUpTo = octant_sets<false>();

// A box of cells as the Morton keys of its corners, cut to a node as the search goes down: below the node's
// own bits, the keys hold where in the node the box begins and ends.
struct KeyBox {
  uint64_t lo, hi;

  // Octants of a node of side 2^level that the box meets.
  uint32_t octants(int level) const {
    return kOctantsFrom[lo >> (3 * level - 3) & 7] & kOctantsUpTo[hi >> (3 * level - 3) & 7];
  }
  bool covers(int level) const {
    const uint64_t below = (uint64_t(1) << (3 * level)) - 1;
    return (lo & below) == 0 && (~hi & below) == 0;
  }
  // Cut to one of those octants: where the box passes the middle of the node, it begins or ends with the
  // child.
  KeyBox child(uint32_t octant, int level) const {
    const uint32_t lo_octant = lo >> (3 * level - 3) & 7, hi_octant = hi >> (3 * level - 3) & 7;
    return {lo & ~kAxes[octant & ~lo_octant], hi | kAxes[hi_octant & ~octant]};
  }
  // All key bits of the axes in a set.
  static constexpr std::array<uint64_t, 8> kAxes = [] {
    std::array<uint64_t, 8> axes{};
    for (uint32_t set = 0; set < 8; ++set) {
      for (uint32_t axis = 0; axis < 3; ++axis)
        axes[set] |= set >> axis & 1 ? spread_bits(kMortonMax) << axis : 0;
    }
    return axes;
  }();
};

// Nodes that wait. One array per member: read as a whole, an entry that was just written in parts would stall
// until its parts have left the store buffer.
struct BoxStack {
  const OctreeNode* node[kStackSize];
  uint64_t lo[kStackSize], hi[kStackSize];
  int level[kStackSize];
  int size = 0;

  void push(const OctreeNode* n, int l, const KeyBox& box) {
    node[size] = n;
    level[size] = l;
    lo[size] = box.lo;
    hi[size++] = box.hi;
  }
  bool pop(const OctreeNode*& n, int& l, KeyBox& box) {
    if (size == 0) return false;
    n = node[--size];
    l = level[size];
    box = {lo[size], hi[size]};
    return true;
  }
};

inline MortonCell child_corner(const MortonCell& corner, uint32_t half, uint32_t octant) {
  return {corner[0] + (octant & 1 ? half : 0), corner[1] + (octant & 2 ? half : 0),
          corner[2] + (octant & 4 ? half : 0)};
}

// A node whose side is at most so many radii is read as a whole: to descend costs more than to test its
// photons.
inline constexpr float kSmallNode = 0.5f;

// The largest level that is small for a radius in cells; negative when none is.
inline int small_level(float radius) {
  const float side = std::min(radius * kSmallNode, float(kMortonMax));
  return side >= 1 ? std::bit_width(uint32_t(side)) - 1 : -1;
}

// A sphere in units of cells, slightly enlarged: rounding moves a photon's computed coordinate by less than a
// cell, and p's by 2^-22 of itself.
struct CellSphere {
  glm::vec3 p;
  glm::vec3 slack;
  float radius_squared;

  CellSphere(const MortonCube& cube, const Point3& point, float radius)
      : p(cube.to_cells(point.x, 0), cube.to_cells(point.y, 1), cube.to_cells(point.z, 2)),
        slack(1.0f + 0x1p-22f * glm::abs(p)) {
    set_radius(cube, radius);
  }
  void set_radius(const MortonCube& cube, float radius) {
    const float r = radius * cube.cells_per_metre;
    radius_squared = r * r * (1 + 0x1p-20f);
  }
  // May the cell hold a photon within the radius? The outermost cells also hold what lies outside the cube.
  bool meets(const MortonCell& corner, uint32_t side) const {
    float sum = 0;
    for (int i = 0; i < 3; ++i) {
      const float below = corner[i] == 0 ? 0 : float(corner[i]) - p[i];
      const float above = corner[i] + side > kMortonMax ? 0 : p[i] - float(corner[i] + side);
      const float gap = std::max(std::max(below, above) - slack[i], 0.0f);
      sum += gap * gap;
    }
    return sum <= radius_squared;
  }
};

}  // namespace octree_detail

template <class Fn>
void Octree::visit_ranges(const Point3& p, float radius, PhotonRange within, Fn&& fn) const {
  using namespace octree_detail;
  if (nodes_.empty() || !(radius >= 0)) return;
  // Rounding in |x - p| <= radius lets photons pass that lie up to a few units in the last place beyond; the
  // quantisation is monotone, so the slightly larger box holds their cells.
  const Vector3 reach(radius * (1 + 0x1p-20f));
  const int small = small_level(radius * cube_.cells_per_metre);
  RangeJoiner<Fn> joiner{fn, within};
  BoxStack stack;
  const OctreeNode* node = nodes_.data();
  int level = kMortonBits;  // of the node: its side is 2^level cells
  KeyBox box{morton_key(cube_.cell(p - reach)), morton_key(cube_.cell(p + reach))};
  for (;;) {
    uint32_t wanted = 0;
    if (node->leaf() || level <= small || box.covers(level)) {
      joiner.add(node->range());
    } else {
      wanted = box.octants(level) & node->child_mask();
    }
    if (wanted == 0) {
      if (!stack.pop(node, level, box)) break;
      continue;
    }
    // On with the lowest octant; the others wait, the next lowest on top.
    const OctreeNode* children = &nodes_[node->first_child];
    while (wanted & (wanted - 1)) {
      const uint32_t octant = 31 - uint32_t(std::countl_zero(wanted));
      wanted ^= 1u << octant;
      stack.push(children + node->child_offset(octant), level - 1, box.child(octant, level));
    }
    const uint32_t octant = uint32_t(std::countr_zero(wanted));
    box = box.child(octant, level);
    node = children + node->child_offset(octant);
    --level;
  }
  joiner.finish();
}

template <class Fn>
void Octree::visit_near_first(const Point3& p, float radius, PhotonRange within, Fn&& fn) const {
  using namespace octree_detail;
  if (nodes_.empty() || !(radius >= 0)) return;
  CellSphere sphere(cube_, p, radius);
  const MortonCell home = cube_.cell(p);

  struct Pending {
    const OctreeNode* node;
    uint32_t half;  // half the side, in cells; 0 at the deepest level
    MortonCell corner;
  };
  Pending stack[kStackSize];
  int top = 0;
  stack[top++] = {nodes_.data(), 1u << (kMortonBits - 1), {}};
  while (top > 0) {
    const Pending at = stack[--top];
    if (!sphere.meets(at.corner, std::max(2 * at.half, 1u))) continue;
    if (at.node->leaf()) {
      const PhotonRange range{std::max<uint64_t>(at.node->begin, within.begin),
                              std::min<uint64_t>(at.node->end, within.end)};
      if (!range.empty()) sphere.set_radius(cube_, fn(range));
      continue;
    }
    const uint32_t near = (home[0] >= at.corner[0] + at.half ? 1u : 0u) |
                          (home[1] >= at.corner[1] + at.half ? 2u : 0u) |
                          (home[2] >= at.corner[2] + at.half ? 4u : 0u);
    for (uint32_t i = 8; i-- > 0;) {
      const uint32_t octant = near ^ i;
      if (!at.node->has_child(octant)) continue;
      stack[top++] = {&nodes_[at.node->child(octant)], at.half / 2, child_corner(at.corner, at.half, octant)};
    }
  }
}

template <class Stop>
int Octree::descend(const PhotonPositions& positions, uint64_t key, PhotonRange (&ranges)[kMortonBits + 1],
                    Stop&& stop) const {
  const OctreeNode* node = nodes_.empty() ? nullptr : nodes_.data();
  ranges[0] = {0, size_};
  int depth = 0;
  while (depth < kMortonBits && !stop(depth, ranges[depth])) {
    const PhotonRange parent = ranges[depth++];
    const uint32_t octant = morton_octant(key, depth);
    if (node == nullptr || node->leaf()) {  // below what is stored
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
