// Resolves mixtures, textures, bump and normal maps at a surface point.

#include "core/scene/bsdf_at.h"

#include "core/scene/shading_normal.h"
#include "core/spectrum/refractive_index.h"

namespace kaustik {

namespace {

// The steps of uv that lead along v on the surface, by least squares (Pharr 2023, equation 10.6).
Vector2 steps_of(const Vector3& v, const SurfaceParameters& s) {
  const float uu = length_squared(s.dpdu), uv = glm::dot(s.dpdu, s.dpdv), vv = length_squared(s.dpdv);
  const float determinant = uu * vv - uv * uv;
  const float u = glm::dot(s.dpdu, v), w = glm::dot(s.dpdv, v);
  const Vector2 steps = Vector2(vv * u - uv * w, uu * w - uv * u) / determinant;
  return std::isfinite(steps.x) && std::isfinite(steps.y) ? steps : Vector2(0);
}

TexturePoint point_of(const SurfaceInteraction& si, const SurfaceParameters& s, const Footprint& footprint) {
  TexturePoint x{si.p, si.n, s.uv, footprint.dpdx, footprint.dpdy};
  x.colour = s.colour;
  if (!is_black(footprint.dpdx) || !is_black(footprint.dpdy)) {
    x.duvdx = steps_of(footprint.dpdx, s);
    x.duvdy = steps_of(footprint.dpdy, s);
  }
  return x;
}

// Clamps a texture's value to [0, 1]; NaN becomes `otherwise`.
float share_of(float value, float otherwise) {
  if (value >= 0) return std::min(value, 1.0f);
  return value < 0 ? 0 : otherwise;
}

float amount_at(const Scene& scene, const MixedMaterial& mixed, const SurfaceInteraction& si,
                const Footprint& footprint) {
  if (mixed.amount_texture == kNoIndex) return mixed.amount;
  const TexturePoint x = texture_point(scene, si, footprint);
  return share_of(scene.textures->evaluate_float(mixed.amount_texture, x), mixed.amount);
}

// Follows mixtures to the chosen material. The loop ends because a mixture refers only to materials defined
// before it.
const Material& chosen(const Scene& scene, const SurfaceInteraction& si, const Vector3& wo,
                       const Footprint& footprint) {
  const Material* material = &scene.materials[si.material];
  while (const MixedMaterial* mixed = material->mixed())
    material = &scene.materials[mixed->choose(si.p, wo, amount_at(scene, *mixed, si, footprint))];
  return *material;
}

}  // namespace

TexturePoint texture_point(const Scene& scene, const SurfaceInteraction& si, const Footprint& footprint) {
  return point_of(si, surface_parameters(scene.shapes[si.shape], si), footprint);
}

void BsdfAt::make(const Scene& scene, const Vector3& wo, const Footprint& footprint, float wavelength,
                  SurfaceInteraction& si) {
  const Material& material = chosen(scene, si, wo, footprint);
  bsdf_ = &material.typical();
  if (material.constant_and_isotropic()) return;
  const SurfaceParameters s = surface_parameters(scene.shapes[si.shape], si);
  if (const TexturedMaterial* textured = material.textured()) {
    const TexturePoint x = point_of(si, s, footprint);
    if (textured->displacement != kNoIndex || textured->normal_map != kNoIndex)
      si.ns = shading_normal(*scene.textures, *textured, x, s, si);
    if (textured->makes_bsdf()) {
      made_ = textured->make(MaterialInputs(textured->inputs, scene.textures.get(), &x));
      bsdf_ = &*made_;
    }
  }
  if (material.dispersion()) disperse(*material.dispersion(), wavelength);
  if (is_anisotropic(*bsdf_)) si.tangent = s.dpdu;
}

void BsdfAt::disperse(const Spectrum& eta, float wavelength) {
  if (!made_) made_ = *bsdf_;
  const double nm = wavelength == kNoWavelength ? kHeliumLine : static_cast<double>(wavelength);
  std::get<Dielectric>(*made_).disperse(eta.at(nm));
  bsdf_ = &*made_;
}

}  // namespace kaustik
