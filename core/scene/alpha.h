#pragma once
// Partly transparent (alpha-masked) surfaces.

#include "core/scene/scene.h"

namespace kaustik {

// Whether a ray stops where it meets a shape with alpha below one. It stops with probability alpha, decided
// by a hash of ray_hash, the triangle and the shape: the same ray always gets the same answer, and
// overlapping surfaces decide independently. (pbrt-v4 hashes the ray as well.) Alpha 0 never stops a ray,
// alpha 1 always does. Textures are looked up at the finest level. Thread-safe.
bool stops_at(const Scene& scene, const Ray& ray, const Hit& hit, uint64_t ray_hash);

// Hash of a ray's bits.
uint64_t hash_ray(const Vector3& o, const Vector3& d);

}  // namespace kaustik
