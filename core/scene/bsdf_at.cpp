#include "core/scene/bsdf_at.h"

#include "core/scene/shading_normal.h"

namespace kaustik {

namespace {

// Steps of uv that lead along v on the surface: least squares (pharr 2023, equation 10.6).
Vector2 steps_of(const Vector3& v, const SurfaceParameters& s) {
  const float uu = length_squared(s.dpdu), uv = glm::dot(s.dpdu, s.dpdv), vv = length_squared(s.dpdv);
  const float determinant = uu * vv - uv * uv;
  const float u = glm::dot(s.dpdu, v), w = glm::dot(s.dpdv, v);
  const Vector2 steps = Vector2(vv * u - uv * w, uu * w - uv * u) / determinant;
  return std::isfinite(steps.x) && std::isfinite(steps.y) ? steps : Vector2(0);
}

TexturePoint point_of(const SurfaceInteraction& si, const SurfaceParameters& s, const Footprint& footprint) {
  TexturePoint x{si.p, si.n, s.uv, footprint.dpdx, footprint.dpdy};
  if (!is_black(footprint.dpdx) || !is_black(footprint.dpdy)) {
    x.duvdx = steps_of(footprint.dpdx, s);
    x.duvdy = steps_of(footprint.dpdy, s);
  }
  return x;
}

}  // namespace

TexturePoint texture_point(const Scene& scene, const SurfaceInteraction& si, const Footprint& footprint) {
  return point_of(si, surface_parameters(scene.shapes[si.shape], si), footprint);
}

void BsdfAt::make(const Scene& scene, const Vector3& wo, const Footprint& footprint, SurfaceInteraction& si) {
  const Material* chosen = &scene.materials[si.material];
  // Mixtures hold materials defined before them only: this ends.
  while (const MixedMaterial* mixed = chosen->mixed()) chosen = &scene.materials[mixed->choose(si.p, wo)];
  bsdf_ = &chosen->typical();
  if (chosen->constant()) return;
  const TexturedMaterial& material = *chosen->textured();
  const SurfaceParameters s = surface_parameters(scene.shapes[si.shape], si);
  const TexturePoint x = point_of(si, s, footprint);
  if (material.displacement != kNoIndex || material.normal_map != kNoIndex)
    si.ns = shading_normal(*scene.textures, material, x, s, si);
  if (!material.makes_bsdf()) return;
  made_ = material.make(MaterialInputs(material.inputs, scene.textures.get(), &x));
  bsdf_ = &*made_;
}

}  // namespace kaustik
