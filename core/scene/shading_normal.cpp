// Bump maps and normal maps (Pharr 2023, section 10.5.3).

#include "core/scene/shading_normal.h"

namespace kaustik {

namespace {

// Step of u or v over which the slope of the height is measured: half a pixel, or a small fraction of the
// surface if the footprint is a point.
constexpr float kPointStep = 0.0005f;
float step_of(float along_x, float along_y) {
  const float step = 0.5f * (std::abs(along_x) + std::abs(along_y));
  return step > 0 ? step : kPointStep;
}

struct Tangents {
  Vector3 u, v;
};

Tangents tangents(const SurfaceParameters& surface, const Normal3& ns) {
  return {surface.dpdu - glm::dot(ns, surface.dpdu) * ns, surface.dpdv - glm::dot(ns, surface.dpdv) * ns};
}

Vector3 bumped(const TextureSet& textures, uint32_t displacement, const TexturePoint& x,
               const SurfaceParameters& surface, const Normal3& ns) {
  const Tangents t = tangents(surface, ns);
  const float du = step_of(x.duvdx.x, x.duvdy.x), dv = step_of(x.duvdx.y, x.duvdy.y);
  TexturePoint along_u = x, along_v = x;
  along_u.p += du * t.u;
  along_u.uv.x += du;
  along_v.p += dv * t.v;
  along_v.uv.y += dv;
  const float height = textures.evaluate_float(displacement, x);
  const float slope_u = (textures.evaluate_float(displacement, along_u) - height) / du;
  const float slope_v = (textures.evaluate_float(displacement, along_v) - height) / dv;
  return glm::cross(t.u + slope_u * ns + height * surface.dndu, t.v + slope_v * ns + height * surface.dndv);
}

Vector3 mapped(const TextureSet& textures, uint32_t image, const TexturePoint& x,
               const SurfaceParameters& surface, const Normal3& ns) {
  constexpr ImageSampling kSampling;
  const Rgb colour = textures.images().lookup(image, kSampling, {x.uv.x, 1 - x.uv.y}, Vector2(0), Vector2(0));
  const Vector3 local = 2.0f * colour - 1.0f;
  const Tangents t = tangents(surface, ns);
  const Vector3 along_u = glm::normalize(t.u), across = glm::cross(ns, along_u);
  // Where uv is mirrored, y still points towards v, as in programs that bake normal maps.
  return local.x * along_u + (glm::dot(across, t.v) < 0 ? -local.y : local.y) * across + local.z * ns;
}

}  // namespace

Normal3 shading_normal(const TextureSet& textures, const TexturedMaterial& material, const TexturePoint& x,
                       const SurfaceParameters& surface, const SurfaceInteraction& si) {
  const Vector3 n = material.displacement != kNoIndex
                        ? bumped(textures, material.displacement, x, surface, si.ns)
                        : mapped(textures, material.normal_map, x, surface, si.ns);
  const float length = glm::length(n);
  if (!(length > 0) || !std::isfinite(length)) return si.ns;
  const Normal3 unit = n / length;
  return glm::dot(unit, si.n) < 0 ? -unit : unit;
}

}  // namespace kaustik
