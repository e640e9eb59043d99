// Builds the octree from sorted photons, and implements the lecture's cell rules.

#include "photon/map/octree.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <stdexcept>

#include "core/parallel/parallel.h"
#include "photon/map/morton_lanes.h"

namespace kaustik::photon {

namespace {

// Photon indices at which the octants of one node begin; the ninth entry is the node's end.
using Splits = std::array<uint64_t, 9>;

// Splits of a node of `depth` whose photons are [begin, end); key_at(i) is the key of photon i.
template <class KeyAt>
Splits find_splits(const KeyAt& key_at, uint64_t begin, uint64_t end, int depth) {
  const auto split = [&](uint64_t from, uint64_t to, uint32_t octant) {
    while (from < to) {
      const uint64_t middle = from + (to - from) / 2;
      if (morton_octant(key_at(middle), depth + 1) < octant)
        from = middle + 1;
      else
        to = middle;
    }
    return from;
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

// Value of OctreeNode::children for these splits.
uint32_t children_of(const Splits& splits) {
  uint32_t bits = 0, before = 0;
  for (uint32_t o = 0; o < 8; ++o) {
    const uint32_t occupied = splits[o] < splits[o + 1];
    bits |= occupied << o | (before & 7) << (8 + 3 * o);
    before += occupied;
  }
  return bits;
}

// Splits the node and appends its children to `nodes`.
template <class KeyAt>
void divide(const KeyAt& key_at, size_t index, int depth, std::vector<OctreeNode>& nodes) {
  const Splits splits = find_splits(key_at, nodes[index].begin, nodes[index].end, depth);
  nodes[index].children = children_of(splits);
  nodes[index].first_child = uint32_t(nodes.size());
  for (size_t o = 0; o < 8; ++o) {
    if (splits[o] < splits[o + 1]) nodes.push_back({uint32_t(splits[o]), uint32_t(splits[o + 1]), 0, 0});
  }
}

// Splits the last of `nodes`, which has depth `depth`, and its descendants level by level while they hold
// more than `limit` photons. Calls leave(node, depth) for the nodes that are not split.
template <class KeyAt, class Fn>
void divide_levels(const KeyAt& key_at, uint64_t limit, int depth, std::vector<OctreeNode>& nodes,
                   const Fn& leave) {
  size_t level = nodes.size() - 1;
  for (; level < nodes.size(); ++depth) {
    const size_t end = nodes.size();
    for (; level < end; ++level) {
      if (depth < kMortonBits && nodes[level].range().size() > limit)
        divide(key_at, level, depth, nodes);
      else
        leave(level, depth);
    }
  }
}

// A node whose descendants are built independently of others, from keys that are computed once.
struct Subtree {
  size_t root;
  int depth;
  std::vector<OctreeNode> nodes;  // the root first; first_child is relative to this array
  size_t first = 0;               // index, in the octree, of the first node below the root
};
constexpr uint64_t kSubtreePhotons = 1 << 15;

void build_subtree(const MortonCube& cube, const PhotonPositions& p, Subtree& subtree,
                   UninitialisedArray<uint64_t>& keys) {
  const OctreeNode& root = subtree.nodes.front();
  if (keys.size() == 0) keys = UninitialisedArray<uint64_t>(kSubtreePhotons);
  morton_keys(cube, p.x + root.begin, p.y + root.begin, p.z + root.begin, {keys.data(), root.range().size()});
  const auto key_at = [first = keys.data(), begin = root.begin](uint64_t i) { return first[i - begin]; };
  divide_levels(key_at, Octree::kLeafPhotons, subtree.depth, subtree.nodes, [](size_t, int) {});
}

// Builds the nodes above the subtrees, level by level, and lists the subtrees, which hold only their roots
// yet.
std::vector<OctreeNode> build_top(const MortonCube& cube, const PhotonPositions& p, uint64_t size,
                                  std::vector<Subtree>& subtrees) {
  std::vector<OctreeNode> top{{0, uint32_t(size), 0, 0}};
  const auto key_at = [&](uint64_t i) { return morton_key(cube.cell(p[i])); };
  divide_levels(key_at, kSubtreePhotons, 0, top, [&](size_t node, int depth) {
    const bool divisible = depth < kMortonBits && top[node].range().size() > Octree::kLeafPhotons;
    if (divisible) subtrees.push_back({node, depth, {top[node]}});
  });
  return top;
}

}  // namespace

Octree::Octree(const MortonCube& cube, const PhotonPositions& positions, uint64_t size)
    : cube_(cube), size_(size) {
  if (size == 0) return;
  std::vector<Subtree> subtrees;
  const std::vector<OctreeNode> top = build_top(cube, positions, size, subtrees);
  tbb::enumerable_thread_specific<UninitialisedArray<uint64_t>> keys;
  parallel::for_index(size_t(0), subtrees.size(),
                      [&](size_t i) { build_subtree(cube, positions, subtrees[i], keys.local()); });

  size_t total = top.size();
  for (Subtree& subtree : subtrees) {
    subtree.first = total;
    total += subtree.nodes.size() - 1;
  }
  UninitialisedArray<OctreeNode> nodes(total);
  std::ranges::copy(top, nodes.begin());
  parallel::for_index(size_t(0), subtrees.size(), [&](size_t i) {
    Subtree& subtree = subtrees[i];
    for (OctreeNode& node : subtree.nodes) {
      if (!node.leaf()) node.first_child += uint32_t(subtree.first - 1);
    }
    nodes[subtree.root] = subtree.nodes.front();
    std::copy(subtree.nodes.begin() + 1, subtree.nodes.end(), nodes.begin() + subtree.first);
  });
  nodes_ = SharedArray(std::move(nodes));
  make_entries(positions);
}

Octree::Octree(const MortonCube& cube, uint64_t size, SharedArray<OctreeNode> nodes,
               SharedArray<uint32_t> entries)
    : cube_(cube), nodes_(std::move(nodes)), entries_(std::move(entries)), size_(size) {
  if (size > 0) entry_depth_ = entry_depth(size);
  check();
}

// Every range lies within the photons, and every child behind its parent, so that a descent ends.
void Octree::check() const {
  const auto require = [](bool holds) {
    if (!holds) throw std::invalid_argument("these are not the nodes of an octree");
  };
  require(nodes_.empty() == (size_ == 0) && entries_.size() == (size_ == 0 ? 0 : entries_of(entry_depth_)));
  parallel::for_index(size_t(0), nodes_.size(), [&](size_t i) {
    const OctreeNode& node = nodes_[i];
    require(node.begin < node.end && node.end <= size_);
    if (node.leaf()) return;
    require(node.first_child > i && node.first_child < nodes_.size());
    for (uint32_t o = 0; o < 8; ++o) require(!node.has_child(o) || node.child(o) < nodes_.size());
  });
  if (entries_.empty()) return;
  require(entries_[entries_.size() - 1] == size_ && std::ranges::is_sorted(entries_));
}

PhotonRange Octree::child_range(const PhotonPositions& positions, PhotonRange range, uint64_t key,
                                int depth) const {
  const uint32_t octant = morton_octant(key, depth);
  // morton_octant() of the photon's key, without the key's other bits.
  const auto octant_of = [&](uint64_t i) {
    const MortonCell cell = cube_.cell(positions[i]);
    const int level = kMortonBits - depth;
    return (cell[0] >> level & 1) | (cell[1] >> level & 1) << 1 | (cell[2] >> level & 1) << 2;
  };
  const auto first_from = [&](PhotonRange r, uint32_t wanted) {
    uint64_t size = r.size();
    while (size > 0) {  // without branches on what is found: they would be mispredicted
      const uint64_t half = size / 2;
      const bool before = octant_of(r.begin + half) < wanted;
      r.begin = before ? r.begin + half + 1 : r.begin;
      size = before ? size - half - 1 : half;
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
