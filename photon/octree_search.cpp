// Which cells a search begins with: no walk from the root, but a table of the nodes of one depth.

#include <algorithm>
#include <bit>

#include "photon/octree.h"

namespace kaustik::photon {

namespace {

constexpr uint64_t kPhotonsPerEntry = 16;

// Key bits of one axis.
constexpr uint64_t kAxes[] = {spread_bits(kMortonMax), spread_bits(kMortonMax) << 1,
                              spread_bits(kMortonMax) << 2};

// At most eight cells of a level, in ascending order.
struct Cells {
  uint64_t key[8];
  size_t size = 1;

  // All with the coordinates of the first or of the last along each axis.
  Cells(uint64_t first, uint64_t last) {
    key[0] = first;
    // An axis along which there are two doubles the cells: first that whose two keys differ in the lowest
    // bits.
    struct Step {
      uint64_t differ, by;
    } steps[3];
    size_t count = 0;
    for (const uint64_t axis : kAxes) {
      const uint64_t differ = (first ^ last) & axis;
      if (differ == 0) continue;
      size_t at = count++;
      for (; at > 0 && steps[at - 1].differ > differ; --at) steps[at] = steps[at - 1];
      steps[at] = {differ, (last & axis) - (first & axis)};
    }
    for (size_t s = 0; s < count; ++s, size *= 2)
      for (size_t i = 0; i < size; ++i) key[size + i] = key[i] + steps[s].by;
  }
};

}  // namespace

void Octree::make_entries(const PhotonPositions& positions) {
  while (uint64_t(8) << (3 * entry_depth_) <= size_ / kPhotonsPerEntry) ++entry_depth_;
  entries_ = UninitialisedArray<uint32_t>((size_t(1) << (3 * entry_depth_)) + 1);
  uint64_t next = 0;  // the first cell whose entry is not set
  const auto begin_cell = [&](uint64_t cell, uint32_t photon) {
    for (; next <= cell; ++next) entries_[next] = photon;
  };
  const auto visit = [&](const auto& self, const OctreeNode& node, uint64_t cell, int depth) -> void {
    if (depth == entry_depth_) return begin_cell(cell, node.begin);
    for (uint32_t o = 0; o < 8; ++o)
      if (node.has_child(o)) self(self, nodes_[node.child(o)], cell << 3 | o, depth + 1);
    for (uint32_t i = node.begin; node.leaf() && i < node.end; ++i)
      begin_cell(morton_key(cube_.cell(positions[i])) >> (3 * (kMortonBits - entry_depth_)), i);
  };
  visit(visit, nodes_[0], 0, 0);
  begin_cell(entries_.size() - 1, uint32_t(size_));
}

CellRanges Octree::ranges_near(const Point3& p, float radius, PhotonRange within) const {
  CellRanges ranges;
  if (nodes_.empty() || !(radius >= 0)) return ranges;
  // Rounding in |x - p| <= radius lets photons pass that lie up to a few units in the last place beyond; the
  // quantisation is monotone, so the slightly larger box holds their cells.
  const Vector3 reach(radius * (1 + 0x1p-20f));
  const MortonCell lo = cube_.cell(p - reach), hi = cube_.cell(p + reach);
  // Cells as wide as the box: it meets two at most along each axis.
  const int narrowest = int(std::bit_width(std::max({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]})));
  const int level = std::max(narrowest, kMortonBits - entry_depth_);
  const Cells cells(morton_key(lo) >> (3 * level), morton_key(hi) >> (3 * level));
  const int shift = 3 * (level - (kMortonBits - entry_depth_));
  for (size_t i = 0; i < cells.size; ++i) {
    const uint64_t begin = std::max<uint64_t>(within.begin, entries_[cells.key[i] << shift]);
    const uint64_t end = std::min<uint64_t>(within.end, entries_[(cells.key[i] + 1) << shift]);
    ranges.first[ranges.size] = uint32_t(begin);
    ranges.last[ranges.size] = uint32_t(end - 1);
    ranges.size += begin < end;
  }
  return ranges;
}

float Octree::guess_radius(const Point3& p, uint64_t photons) const {
  if (nodes_.empty()) return 0;
  const uint64_t key = morton_key(cube_.cell(p));
  const OctreeNode* node = nodes_.data();
  int depth = 0;
  for (; !node->leaf(); ++depth) {
    const uint32_t octant = morton_octant(key, depth + 1);
    if (!node->has_child(octant)) break;
    const OctreeNode* child = &nodes_[node->child(octant)];
    if (child->range().size() < 2 * photons) break;
    node = child;
  }
  // Photons are counted, so that their number scatters by its root.
  const float wanted = 1.2f * float(photons) + 2 * std::sqrt(float(photons));
  return std::ldexp(cube_.size, -depth) * std::sqrt(wanted / (kPi * float(node->range().size())));
}

}  // namespace kaustik::photon
