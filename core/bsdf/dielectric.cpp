// Rough dielectric boundaries: reflection and refraction at GGX microfacets (Walter et al. 2007). Smooth
// boundaries with tints.

#include "core/bsdf/dielectric.h"

namespace kaustik {

namespace {

// A facet that scatters light between wo and wi, with wm on the side of wo. relative: index of the far side
// over that of wo's side; one for reflection.
struct Facet {
  Vector3 wm;
  float relative, cos_o, cos_i;  // |wo.wm|, |wi.wm|
  float reflectance;
  bool reflects;

  // Derivative of the solid angle of wm by that of wi (Walter et al. 2007, equations 14 and 17).
  float jacobian() const {
    if (reflects) return 1 / (4 * cos_o);
    const float sum = cos_i - cos_o / relative;
    return cos_i / (sum * sum);
  }
};

// Returns nothing if no facet leads from one direction to the other.
std::optional<Facet> facet_between(const Vector3& wo, const Vector3& wi, float eta) {
  if (wo.z == 0 || wi.z == 0) return std::nullopt;
  Facet facet;
  facet.reflects = same_hemisphere(wo, wi);
  const float inside = wo.z > 0 ? eta : 1 / eta;
  facet.relative = facet.reflects ? 1 : inside;
  const Vector3 sum = facet.relative * wi + wo;
  if (length_squared(sum) == 0) return std::nullopt;
  facet.wm = glm::normalize(sum);
  if (facet.wm.z * wo.z < 0) facet.wm = -facet.wm;
  // Either direction may see the facet from behind.
  const float o = glm::dot(wo, facet.wm), i = glm::dot(wi, facet.wm);
  if (!(o > 0) || !(facet.reflects ? i > 0 : i < 0)) return std::nullopt;
  facet.cos_o = o;
  facet.cos_i = std::abs(i);
  facet.reflectance = fresnel_dielectric(o, inside);
  return facet;
}

}  // namespace

Rgb Dielectric::f_rough(const Vector3& wo, const Vector3& wi) const {
  const auto facet = facet_between(wo, wi, eta);
  if (!facet) return Rgb(0);
  const float D_G = facets.D(facet->wm) * facets.masking(wo, wi);  // G over 4 |cos wo cos wi|
  const Rgb& tint = tints.of_lobe(!facet->reflects);
  if (facet->reflects) return tint * (facet->reflectance * D_G);
  const float per_eta2 = 1 / (facet->relative * facet->relative);
  return tint * ((1 - facet->reflectance) * D_G * 4 * facet->cos_o * facet->jacobian() * per_eta2);
}

float Dielectric::pdf_rough(const Vector3& wo, const Vector3& wi) const {
  const auto facet = facet_between(wo, wi, eta);
  if (!facet) return 0;
  const LobeChances chances = tints.chances(facet->reflectance);
  const float lobe = facet->reflects ? chances.reflection : chances.transmission;
  return facets.visible_D(wo, facet->wm) * facet->jacobian() * lobe;
}

std::optional<BsdfSample> Dielectric::sample_rough(const Vector3& wo, float uc, const Point2& u,
                                                   TransportMode mode) const {
  const bool glossy = facets.is_narrow();
  const float relative = wo.z > 0 ? eta : 1 / eta;
  Facet facet{facets.sample_visible(wo, u), 1, 0, 0, 0, true};
  facet.cos_o = std::clamp(glm::dot(wo, facet.wm), 0.0f, 1.0f);
  const float cos_t = refracted_cosine(facet.cos_o, relative);
  facet.reflectance = fresnel_from_cosines(facet.cos_o, cos_t, relative);
  const LobeChances chances = tints.chances(facet.reflectance);
  facet.reflects = uc < chances.reflection;
  Vector3 wi = 2 * facet.cos_o * facet.wm - wo;
  float lobe = chances.reflection, scale = 1;
  if (!facet.reflects) {
    facet.relative = relative;
    facet.cos_i = cos_t;
    wi = (facet.cos_o / relative - cos_t) * facet.wm - wo / relative;
    lobe = chances.transmission;
    if (mode == TransportMode::kRadiance) scale = 1 / (relative * relative);
  }
  const float pdf = facets.visible_D(wo, facet.wm) * facet.jacobian() * lobe;
  if (wi.z == 0 || same_hemisphere(wo, wi) != facet.reflects || !is_density(pdf)) return std::nullopt;
  Rgb weight(scale * facets.unshadowed(wo, wi));
  if (tints.tinted()) weight *= tints.weight(!facet.reflects, facet.reflectance, lobe);
  return BsdfSample{wi, weight, pdf, glossy, !facet.reflects, glossy};
}

std::optional<BsdfSample> Dielectric::sample_tinted(const Vector3& wo, float uc, TransportMode mode) const {
  const float relative = wo.z > 0 ? eta : 1 / eta, inverse = 1 / relative;
  const float cos_i = std::min(std::abs(wo.z), 1.0f), cos_t = refracted_cosine(cos_i, relative);
  const float fresnel = eta == 1 ? 0 : fresnel_from_cosines(cos_i, cos_t, relative);
  const auto [reflection, transmission] = tints.chances(fresnel);
  if (uc < reflection)
    return BsdfSample{
        {-wo.x, -wo.y, wo.z}, tints.weight(false, fresnel, reflection), reflection, true, false};
  if (!(transmission > 0)) return std::nullopt;
  const float scale = mode == TransportMode::kRadiance ? inverse * inverse : 1.0f;
  const Vector3 wi = eta == 1 ? -wo : refracted(wo, inverse, cos_t);
  return BsdfSample{wi, scale * tints.weight(true, fresnel, transmission), transmission, true, true};
}

}  // namespace kaustik
