// Chooses the cube that Morton keys are relative to.

#include "photon/map/morton.h"

namespace kaustik::photon {

MortonCube MortonCube::around(const Bounds3& bounds) {
  MortonCube cube;
  if (bounds.empty() || !is_finite(bounds.min) || !is_finite(bounds.max)) return cube;
  constexpr float kMargin = 1.0f / 12;
  const float extent = max_component(bounds.diagonal());
  // Bounds without extent still need a cube that is large compared with the rounding errors of its
  // coordinates.
  const float magnitude = max_component(glm::max(glm::abs(bounds.min), glm::abs(bounds.max)));
  const float needed = std::max(extent * (1 / (1 - kMargin)), magnitude * 0x1p-20f);
  if (!(needed > 0) || !std::isfinite(needed)) return cube;
  // Limits the exponent so that side, cell size and reciprocal are normal numbers.
  const int exponent = std::clamp(std::ilogb(needed) + 1, -100, 126);
  cube.size = std::ldexp(1.0f, exponent);
  cube.cells_per_metre = std::ldexp(1.0f, kMortonBits - exponent);
  cube.origin = bounds.min - Vector3(kMargin * cube.size);
  return cube;
}

Bounds3 MortonCube::cell_bounds(const MortonCell& cell, int depth) const {
  const uint32_t side = 1u << (kMortonBits - depth);
  Bounds3 bounds;
  for (int i = 0; i < 3; ++i) {
    const uint32_t lo = cell[size_t(i)] & ~(side - 1);
    bounds.min[i] = origin[i] + float(lo) / cells_per_metre;
    bounds.max[i] = origin[i] + float(lo + side) / cells_per_metre;
  }
  return bounds;
}

}  // namespace kaustik::photon
