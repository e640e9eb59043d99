#pragma once
// Partly transparent (alpha-masked) surfaces, decided inside Embree's traversal: a rejected hit does not end
// the ray.

#include <cstdint>

#include "accel/embree_api.h"
#include "core/scene/scene.h"

namespace kaustik::accel {

// User data of a mesh with alpha. Embree keeps a pointer to it, so it must not move while rays are traced.
struct AlphaMesh {
  const Scene* scene = nullptr;
  uint32_t shape = kNoIndex;  // kNoIndex: the hit's instance names the shape
};
void set_alpha_filter(RTCGeometry geometry, const AlphaMesh* mesh);

// Hash of ray i of N, from the coordinates that Embree sees, which are the same at every scale of the scene.
uint64_t hash_of_ray(RTCRayN* rays, unsigned N, unsigned i);

}  // namespace kaustik::accel
