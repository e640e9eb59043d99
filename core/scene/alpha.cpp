// Decides by a hash whether a ray stops at a partly transparent surface.

#include "core/scene/alpha.h"

#include <bit>

#include "core/sampling/sampler.h"
#include "core/scene/bsdf_at.h"

namespace kaustik {

namespace {

float alpha_at(const Scene& scene, const Ray& ray, const Hit& hit) {
  const Shape& shape = scene.shapes[hit.shape];
  if (shape.alpha_texture == kNoIndex) return shape.alpha;
  const SurfaceInteraction si = make_interaction(scene.shapes, ray, hit);
  return scene.textures->evaluate_float(shape.alpha_texture, texture_point(scene, si));
}

}  // namespace

uint64_t hash_ray(const Vector3& o, const Vector3& d) {
  uint64_t hash = 0;
  for (const float x : {o.x, o.y, o.z, d.x, d.y, d.z}) hash = hash_combine(hash, std::bit_cast<uint32_t>(x));
  return hash;
}

bool stops_at(const Scene& scene, const Ray& ray, const Hit& hit, uint64_t ray_hash) {
  const float alpha = alpha_at(scene, ray, hit);
  if (alpha >= 1) return true;
  if (!(alpha > 0)) return false;
  const uint64_t primitive = uint64_t{hit.shape} << 32 | hit.primitive;
  return unit_number(hash_combine(ray_hash, primitive)) < alpha;
}

}  // namespace kaustik
