#include "photon/cell_table.h"

#include <algorithm>
#include <bit>

namespace kaustik::photon {

namespace {

constexpr uint64_t kPhotonsPerCell = 16;

// Key bits of one axis.
constexpr uint64_t kAxis[] = {spread_bits(kMortonMax), spread_bits(kMortonMax) << 1,
                              spread_bits(kMortonMax) << 2};

}  // namespace

CellTable::CellTable(const Octree& octree, const PhotonPositions& positions) : cube_(octree.cube()) {
  if (octree.size() == 0) return;
  while (uint64_t(8) << (3 * depth_) <= octree.size() / kPhotonsPerCell) ++depth_;
  begin_ = UninitialisedArray<uint32_t>((size_t(1) << (3 * depth_)) + 1);
  const int shift = 3 * (kMortonBits - depth_);
  uint64_t next = 0;  // first cell that is not filled
  const auto fill = [&](uint64_t cell, uint32_t photon) {
    for (; next <= cell; ++next) begin_[next] = photon;
  };
  // In the order of the keys, down to the depth of the table.
  const auto visit = [&](const auto& self, const OctreeNode& node, uint64_t cell, int depth) -> void {
    if (depth == depth_) {
      fill(cell, node.begin);
    } else if (node.leaf()) {
      for (uint32_t i = node.begin; i < node.end; ++i) fill(morton_key(cube_.cell(positions[i])) >> shift, i);
    } else {
      for (uint32_t o = 0; o < 8; ++o)
        if (node.has_child(o)) self(self, octree.nodes()[node.child(o)], cell << 3 | o, depth + 1);
    }
  };
  visit(visit, octree.nodes()[0], 0, 0);
  fill(begin_.size() - 1, uint32_t(octree.size()));
}

CellRanges CellTable::ranges_near(const Point3& p, float radius, PhotonRange within) const {
  CellRanges ranges;
  if (begin_.empty() || !(radius >= 0)) return ranges;
  // Rounding in |x - p| <= radius lets photons pass that lie up to a few units in the last place beyond; the
  // quantisation is monotone, so the slightly larger box holds their cells.
  const Vector3 reach(radius * (1 + 0x1p-20f));
  const MortonCell lo = cube_.cell(p - reach), hi = cube_.cell(p + reach);
  const uint32_t widest = std::max({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]});
  // Cells as wide as the box: it meets two at most along each axis.
  const int level = std::max(kMortonBits - depth_, int(std::bit_width(widest)));
  const int shift = 3 * (level - (kMortonBits - depth_));
  const uint64_t first = morton_key(lo) >> (3 * level), last = morton_key(hi) >> (3 * level);
  // The first cells of the ranges in ascending order: one; then, for each axis along which there are two,
  // from that whose cells differ in the lowest bit, twice as many.
  struct Step {
    uint64_t differ, by;
  } steps[3];
  size_t axes = 0;
  for (const uint64_t axis : kAxis) {
    const uint64_t differ = (first ^ last) & axis;
    if (differ == 0) continue;
    size_t at = axes++;
    for (; at > 0 && steps[at - 1].differ > differ; --at) steps[at] = steps[at - 1];
    steps[at] = {differ, (last & axis) - (first & axis)};
  }
  uint64_t cells[8];
  cells[0] = first;
  size_t count = 1;
  for (size_t s = 0; s < axes; ++s, count *= 2)
    for (size_t i = 0; i < count; ++i) cells[count + i] = cells[i] + steps[s].by;
  for (size_t i = 0; i < count; ++i) {
    const uint64_t begin = std::max<uint64_t>(within.begin, begin_[cells[i] << shift]);
    const uint64_t end = std::min<uint64_t>(within.end, begin_[(cells[i] + 1) << shift]);
    ranges.first[ranges.size] = uint32_t(begin);
    ranges.last[ranges.size] = uint32_t(end - 1);
    ranges.size += begin < end;
  }
  return ranges;
}

}  // namespace kaustik::photon
