#pragma once
// Surfaces that are there in part, decided inside Embree's traversal: rejected hits do not end a ray.

#include <cstdint>

#include "accel/embree_api.h"
#include "core/scene/scene.h"

namespace kaustik::accel {

// A mesh with alpha. Embree points to it while rays are traced.
struct AlphaMesh {
  const Scene* scene = nullptr;
  uint32_t shape = kNoIndex;  // none: that of the instance
};
void set_alpha_filter(RTCGeometry geometry, const AlphaMesh* mesh);

// Of ray i of N, by Embree's own coordinates, which are the same at every scale of scene.
uint64_t hash_of_ray(RTCRayN* rays, unsigned N, unsigned i);

}  // namespace kaustik::accel
