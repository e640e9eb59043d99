#pragma once
// 63-bit Morton keys: 21 bits per axis, interleaved, within a cube whose side is a power of two. Scaling a
// scene by a power of two scales origin and side exactly, so the keys do not change.

#include <array>
#include <cstdint>

#include "core/math/bounds.h"

namespace kaustik::photon {

inline constexpr int kMortonBits = 21;  // per axis; also the deepest level of the octree
inline constexpr uint32_t kMortonMax = (1u << kMortonBits) - 1;

using MortonCell = std::array<uint32_t, 3>;  // integer coordinates at level kMortonBits

// The cube that keys are relative to; also the octree's root.
struct MortonCube {
  Point3 origin{0};
  float size = 1;                             // side, metres: a power of two
  float cells_per_metre = 1u << kMortonBits;  // 2^21 / size

  // The smallest cube of power-of-two side that holds the bounds with a margin of size/12 below them. The
  // margin keeps walls off the faces of cells: at every level from the second on, a wall at the lower bound
  // is a third of a cell away from the nearest face. Empty or non-finite bounds give the unit cube.
  static MortonCube around(const Bounds3& bounds);

  // Coordinate in cells along an axis, in [0, 2^21] for points in the cube. Monotone in p.
  float to_cells(float p, int axis) const { return (p - origin[axis]) * cells_per_metre; }
  // Integer cell coordinate, clamped to the cube; NaN gives 0. Monotone in p, so that an interval of p maps
  // to an interval of cells.
  uint32_t quantise(float p, int axis) const {
    const float t = to_cells(p, axis);
    return t > 0 ? (t < float(kMortonMax) ? uint32_t(t) : kMortonMax) : 0u;
  }
  MortonCell cell(const Point3& p) const { return {quantise(p.x, 0), quantise(p.y, 1), quantise(p.z, 2)}; }
  // Bounds, in metres, of the cell of side size / 2^depth that contains these integer coordinates.
  Bounds3 cell_bounds(const MortonCell& cell, int depth) const;

  bool operator==(const MortonCube&) const = default;
};

// Inserts two zero bits between any two of the lower 21 bits of v.
constexpr uint64_t spread_bits(uint32_t v) {
  uint64_t x = v & kMortonMax;
  x = (x | x << 32) & 0x001f00000000ffffull;
  x = (x | x << 16) & 0x001f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  x = (x | x << 2) & 0x1249249249249249ull;
  return x;
}

// Interleaves the coordinates: x in the lowest bit of each triple, then y, then z.
constexpr uint64_t morton_key(const MortonCell& cell) {
  return spread_bits(cell[0]) | spread_bits(cell[1]) << 1 | spread_bits(cell[2]) << 2;
}
// Octant of its parent in which the cell of this depth (1 to 21) on the way to the key lies.
constexpr uint32_t morton_octant(uint64_t key, int depth) {
  return uint32_t(key >> (3 * (kMortonBits - depth))) & 7u;
}

}  // namespace kaustik::photon
