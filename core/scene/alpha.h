#pragma once
#include "core/scene/scene.h"

namespace kaustik {

// Whether a ray stops where it meets a shape whose alpha is below one: with probability alpha, decided by
// ray_hash, the triangle and the shape, so that the same ray always gets the same answer and the layers of a
// canopy are independent. (pbrt-v4 hashes the ray as well.) alpha 0 never stops it, 1 always. Textures are
// looked up at the finest level. Thread-safe.
bool stops_at(const Scene& scene, const Ray& ray, const Hit& hit, uint64_t ray_hash);

// Of the ray's bits.
uint64_t hash_ray(const Vector3& o, const Vector3& d);

}  // namespace kaustik
