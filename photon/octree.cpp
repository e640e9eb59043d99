// The octree, built level by level from sorted keys, and the lecture's cell rules.

#include "photon/octree.h"

#include <tbb/parallel_for.h>

namespace kaustik::photon {

namespace {

// Where the octants of one node begin; the ninth entry is the node's end.
using Splits = std::array<uint64_t, 9>;

// first[i] of the octants of a node of `depth` whose photons are [begin, end).
Splits find_splits(std::span<const uint64_t> keys, uint64_t begin, uint64_t end, int depth) {
  const auto split = [&](uint64_t from, uint64_t to, uint32_t octant) {
    const auto below = [&](uint64_t key) { return morton_octant(key, depth + 1) < octant; };
    return uint64_t(
        std::partition_point(keys.begin() + ptrdiff_t(from), keys.begin() + ptrdiff_t(to), below) -
        keys.begin());
  };
  Splits s{};
  s[0] = begin;
  s[8] = end;
  s[4] = split(s[0], s[8], 4);
  for (const uint32_t half : {0u, 4u}) {
    s[half + 2] = split(s[half], s[half + 4], half + 2);
    s[half + 1] = split(s[half], s[half + 2], half + 1);
    s[half + 3] = split(s[half + 2], s[half + 4], half + 3);
  }
  return s;
}

// OctreeNode::children of a node with these splits.
uint32_t children_of(const Splits& splits) {
  uint32_t bits = 0, before = 0;
  for (uint32_t o = 0; o < 8; ++o) {
    const uint32_t occupied = splits[o] < splits[o + 1];
    bits |= occupied << o | (before & 7) << (8 + 3 * o);
    before += occupied;
  }
  return bits;
}

constexpr size_t kGrain = 256;

template <class Fn>
void for_each_index(size_t size, const Fn& fn) {
  tbb::parallel_for(tbb::blocked_range<size_t>(0, size, kGrain),
                    [&](const tbb::blocked_range<size_t>& block) {
                      for (size_t i = block.begin(); i < block.end(); ++i) fn(i);
                    });
}

// Nodes [first, last) of one level.
struct Level {
  size_t first, last;
};

// Appends the children of the level's nodes.
Level build_next_level(std::span<const uint64_t> keys, int depth, Level level,
                       std::vector<OctreeNode>& nodes) {
  std::vector<Splits> splits(level.last - level.first);
  for_each_index(splits.size(), [&](size_t i) {
    OctreeNode& node = nodes[level.first + i];
    if (node.range().size() <= Octree::kLeafPhotons) return;
    splits[i] = find_splits(keys, node.begin, node.end, depth);
    node.children = children_of(splits[i]);
  });

  size_t total = nodes.size();
  for (size_t i = level.first; i < level.last; ++i) {
    nodes[i].first_child = uint32_t(total);
    total += size_t(std::popcount(nodes[i].child_mask()));
  }
  nodes.resize(total);
  for_each_index(splits.size(), [&](size_t i) {
    const OctreeNode& node = nodes[level.first + i];
    for (uint32_t octant = 0; octant < 8; ++octant) {
      if (!node.has_child(octant)) continue;
      nodes[node.child(octant)] = {uint32_t(splits[i][octant]), uint32_t(splits[i][octant + 1]), 0, 0};
    }
  });
  return {level.last, total};
}

}  // namespace

Octree::Octree(const MortonCube& cube, std::span<const uint64_t> keys) : cube_(cube), size_(keys.size()) {
  if (keys.empty()) return;
  nodes_.push_back({0, uint32_t(keys.size()), 0, 0});
  Level level{0, 1};
  for (int depth = 0; depth < kMortonBits && level.first < level.last; ++depth) {
    level = build_next_level(keys, depth, level, nodes_);
  }
  nodes_.shrink_to_fit();
}

PhotonRange Octree::child_range(const PhotonPositions& positions, PhotonRange range, uint64_t key,
                                int depth) const {
  const uint32_t octant = morton_octant(key, depth);
  const auto first_from = [&](PhotonRange r, uint32_t wanted) {
    while (!r.empty()) {
      const uint64_t middle = r.begin + r.size() / 2;
      const uint64_t k = morton_key(cube_.cell(positions[middle]));
      if (morton_octant(k, depth) < wanted)
        r.begin = middle + 1;
      else
        r.end = middle;
    }
    return r.begin;
  };
  const uint64_t begin = first_from(range, octant);
  return {begin, first_from({begin, range.end}, octant + 1)};
}

bool Octree::children_hold(float radius, int depth) const {
  if (depth >= kMortonBits) return false;
  const float child_side = float(1u << (kMortonBits - depth - 1));
  return child_side >= 2 * radius * cube_.cells_per_metre;
}

bool Octree::keeps_from_faces(const Point3& p, float radius, int depth) const {
  const uint32_t side = 1u << (kMortonBits - depth);
  const float r = radius * cube_.cells_per_metre;
  for (int i = 0; i < 3; ++i) {
    const uint32_t lo = cube_.quantise(p[i], i) & ~(side - 1), hi = lo + side;
    const float t = cube_.to_cells(p[i], i);
    if (lo > 0 && t - float(lo) < r) return false;
    if (hi <= kMortonMax && float(hi) - t < r) return false;
  }
  return true;
}

OctreeCell Octree::make_cell(const Point3& p, PhotonRange range, int depth, int climbed) const {
  OctreeCell cell{range, cube_.cell(p), depth, climbed, {}};
  for (uint32_t& c : cell.corner) c &= ~((1u << (kMortonBits - depth)) - 1);
  cell.bounds = cube_.cell_bounds(cell.corner, depth);
  return cell;
}

OctreeCell Octree::find_cell(const PhotonPositions& positions, const Point3& p, uint32_t node_photons,
                             float radius) const {
  PhotonRange ranges[kMortonBits + 1];
  const int leaf = descend(positions, morton_key(cube_.cell(p)), ranges, [&](int depth, PhotonRange range) {
    return range.size() <= node_photons || !children_hold(radius, depth);
  });
  int depth = leaf;
  while (depth > 0 && !keeps_from_faces(p, radius, depth)) --depth;
  return make_cell(p, ranges[depth], depth, leaf - depth);
}

}  // namespace kaustik::photon
