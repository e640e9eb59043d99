#pragma once
// intersect_sphere() for many rays at once, in SIMD lanes.

#include <cstddef>

#include "core/geometry/analytic/sphere.h"

namespace kaustik {

// The largest number of rays per call.
inline constexpr size_t kSphereLanes = 16;

// Rays as structure of arrays, aligned to 64 bytes and readable for kSphereLanes rays.
struct SphereRays {
  const float *o[3], *d[3], *t_max;
};

// Sets t[k] = intersect_sphere(sphere, ray k) for the first `count` rays, with the same bits on every
// instruction set. May write up to kSphereLanes values. Thread-safe.
void intersect_sphere_lanes(const Sphere& sphere, const SphereRays& rays, size_t count, float* t);

}  // namespace kaustik
