#pragma once
// Rays as structure of arrays, and their hits.

#include <cstddef>
#include <cstdint>

#include "core/geometry/interaction.h"

namespace kaustik::accel {

inline constexpr size_t kRayLanes = 64;

// Rays with t_max = infinity. Directions need not be of unit length.
struct RayLanes {
  alignas(64) float o[3][kRayLanes], d[3][kRayLanes];

  Ray get(size_t k) const { return {{o[0][k], o[1][k], o[2][k]}, {d[0][k], d[1][k], d[2][k]}}; }
};

// A Hit per lane. shape is kNoIndex where a ray escapes; the lane's other values are then unspecified.
struct HitLanes {
  alignas(64) float t[kRayLanes], u[kRayLanes], v[kRayLanes];
  uint32_t shape[kRayLanes], primitive[kRayLanes];

  bool valid(size_t k) const { return shape[k] != kNoIndex; }
  Hit get(size_t k) const { return {t[k], shape[k], primitive[k], {u[k], v[k]}}; }
  void set(size_t k, const Hit& hit) {
    t[k] = hit.t;
    u[k] = hit.uv.x;
    v[k] = hit.uv.y;
    shape[k] = hit.shape;
    primitive[k] = hit.primitive;
  }
};

}  // namespace kaustik::accel
