// Finds the cells at which a search begins with a table of the cells at one depth, instead of descending from
// the root.

#include <algorithm>
#include <bit>

#include "photon/map/octree.h"

namespace kaustik::photon {

namespace {

constexpr uint64_t kPhotonsPerEntry = 16;

// Most key bits per axis of the table, for fewer than 2^32 photons.
constexpr int kEntryBits = 9;
static_assert(kPhotonsPerEntry << (3 * kEntryBits + 3) > uint64_t{1} << 32);

// Both ends of an interval of cells, each of kEntryBits, are spread in one word: their bits do not overlap.
constexpr int kUpperEnd = 36;
constexpr uint64_t both_ends(uint64_t x) {
  return x | x << kUpperEnd;
}
// Computes spread_bits() of both ends of [lo, hi].
constexpr uint64_t spread_ends(uint32_t lo, uint32_t hi) {
  uint64_t x = lo | uint64_t{hi} << kUpperEnd;
  x = (x | x << 16) & both_ends(0x10000ff);
  x = (x | x << 8) & both_ends(0x100f00f);
  x = (x | x << 4) & both_ends(0x10c30c3);
  return (x | x << 2) & both_ends(0x1249249);
}

// At most eight cells of a level, two along each axis, in ascending order of keys. Branchless, since branches
// would depend on the query and be mispredicted.
struct Cells {
  uint32_t key[8];
  size_t stride;  // step from one cell to the next; the entries between repeat the same cell

  Cells(const MortonCell& lo, const MortonCell& hi, int level) {
    uint32_t first = 0, step[3];
    for (size_t a = 0; a < 3; ++a) {
      const uint64_t ends = spread_ends(lo[a] >> level, hi[a] >> level) << a;
      const uint32_t from = uint32_t(ends & ((uint64_t{1} << (kUpperEnd - 1)) - 1));
      first |= from;
      step[a] = uint32_t(ends >> kUpperEnd) - from;
    }
    // Sort the steps; axes with only one cell have step 0. The larger of two steps exceeds the sum of all
    // smaller ones, so the sums below ascend.
    const uint32_t low = std::min(step[0], step[1]), high = std::max(step[0], step[1]);
    const uint32_t s0 = std::min(low, step[2]), s1 = std::max(low, std::min(high, step[2]));
    const uint32_t s2 = std::max(high, step[2]);
    const uint32_t second = first + s2;
    const uint32_t sums[8] = {first,  first + s0,  first + s1,  first + s1 + s0,
                              second, second + s0, second + s1, second + s1 + s0};
    std::copy_n(sums, 8, key);
    stride = size_t{1} << ((s0 == 0) + (s1 == 0) + (s2 == 0));
  }
};

}  // namespace

int Octree::entry_depth(uint64_t size) {
  int depth = 0;
  while (uint64_t(8) << (3 * depth) <= size / kPhotonsPerEntry) ++depth;
  return depth;
}

void Octree::make_entries(const PhotonPositions& positions) {
  entry_depth_ = entry_depth(size_);
  UninitialisedArray<uint32_t> entries(entries_of(entry_depth_));
  uint64_t next = 0;  // the first cell whose entry is not set yet
  const auto begin_cell = [&](uint64_t cell, uint32_t photon) {
    for (; next <= cell; ++next) entries[next] = photon;
  };
  const auto visit = [&](const auto& self, const OctreeNode& node, uint64_t cell, int depth) -> void {
    if (depth == entry_depth_) return begin_cell(cell, node.begin);
    for (uint32_t o = 0; o < 8; ++o)
      if (node.has_child(o)) self(self, nodes_[node.child(o)], cell << 3 | o, depth + 1);
    for (uint32_t i = node.begin; node.leaf() && i < node.end; ++i)
      begin_cell(morton_key(cube_.cell(positions[i])) >> (3 * (kMortonBits - entry_depth_)), i);
  };
  visit(visit, nodes_[0], 0, 0);
  begin_cell(entries.size() - 1, uint32_t(size_));
  entries_ = SharedArray(std::move(entries));
}

CellRanges Octree::ranges_near(const Point3& p, float radius, PhotonRange within) const {
  CellRanges ranges;
  if (nodes_.empty() || !(radius >= 0)) return ranges;
  // Because of rounding, |x - p| <= radius accepts photons up to a few units in the last place farther away.
  // Quantisation is monotone, so the cells of the slightly enlarged box contain them.
  const Vector3 reach(radius * (1 + 0x1p-20f));
  const MortonCell lo = cube_.cell(p - reach), hi = cube_.cell(p + reach);
  // With cells at least as wide as the box, it meets at most two along each axis.
  const int narrowest = int(std::bit_width((hi[0] - lo[0]) | (hi[1] - lo[1]) | (hi[2] - lo[2])));
  const int level = std::max(narrowest, kMortonBits - entry_depth_);
  const Cells cells(lo, hi, level);
  const int shift = 3 * (level - (kMortonBits - entry_depth_));
  for (size_t i = 0; i < 8; i += cells.stride) {
    const size_t key = cells.key[i];
    const uint64_t begin = std::max<uint64_t>(within.begin, entries_[key << shift]);
    const uint64_t end = std::min<uint64_t>(within.end, entries_[(key + 1) << shift]);
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
  // Add two standard deviations, since the number of photons in a disc varies by its root.
  const float wanted = 1.2f * float(photons) + 2 * std::sqrt(float(photons));
  return std::ldexp(cube_.size, -depth) * std::sqrt(wanted / (kPi * float(node->range().size())));
}

}  // namespace kaustik::photon
