#pragma once
// Intersects groups of rays.

#include "accel/bvh.h"
#include "photon/trace/lanes/surface_table.h"

namespace kaustik::photon::detail {

// A hit names a triangle, whose vertices lie two dependent loads away and are often not in the cache.
// Prefetching those of a whole group before the first is needed hides most of the latency. Must be inlined:
// GCC 12 considers a function that only prefetches free of effects and drops the call.
[[gnu::always_inline]] inline void prefetch_triangles(const SurfaceTable& surfaces,
                                                      const accel::HitLanes& hits, size_t count) {
  const auto triangle = [&](size_t k, const SurfaceRow& surface) {
    return &surface.indices[hits.primitive[k] & surface.primitives];
  };
  for (size_t k = 0; k < count; ++k) __builtin_prefetch(triangle(k, surfaces.row(hits.shape[k])));
  for (size_t k = 0; k < count; ++k) {
    const SurfaceRow& surface = surfaces.row(hits.shape[k]);
    for (uint32_t vertex : *triangle(k, surface)) __builtin_prefetch(&surface.P[vertex]);
  }
}

// Intersects in packets if the accelerator supports them.
template <class Accel>
void intersect_lanes(const Accel& bvh, const accel::RayLanes& rays, size_t count, accel::HitLanes* hits) {
  if constexpr (requires { bvh.intersect(rays, count, hits); }) {
    bvh.intersect(rays, count, hits);
  } else {
    for (size_t k = 0; k < count; ++k) hits->set(k, bvh.intersect(rays.get(k)));
  }
}

}  // namespace kaustik::photon::detail
