// Evaluation and sampling of metal.

#include "core/bsdf/conductor.h"

#include "core/bsdf/microfacet/fresnel.h"

namespace kaustik {

Rgb Conductor::reflectance(float cos_theta_i) const {
  return {fresnel_conductor(cos_theta_i, eta.x, k.x), fresnel_conductor(cos_theta_i, eta.y, k.y),
          fresnel_conductor(cos_theta_i, eta.z, k.z)};
}

Rgb Conductor::f_rough(const Vector3& wo, const Vector3& wi) const {
  if (!same_hemisphere(wo, wi)) return Rgb(0);
  const Vector3 wm = glm::normalize(wo + wi);
  return reflectance(glm::dot(wo, wm)) * (facets.D(wm) * facets.masking(wo, wi));
}

float Conductor::pdf_rough(const Vector3& wo, const Vector3& wi) const {
  return same_hemisphere(wo, wi) ? facets.reflection_pdf(wo, glm::normalize(wo + wi)) : 0;
}

std::optional<BsdfSample> Conductor::sample_f(const Vector3& wo, float /*uc*/, const Point2& u,
                                              TransportMode /*mode*/) const {
  if (wo.z == 0) return std::nullopt;
  if (facets.smooth()) return BsdfSample{{-wo.x, -wo.y, wo.z}, reflectance(wo.z), 1, true, false};
  const bool glossy = facets.is_narrow();
  const Vector3 wm = facets.sample_visible(wo, u);
  const float c = glm::dot(wo, wm);
  const Vector3 wi = 2 * c * wm - wo;
  const float pdf = facets.reflection_pdf(wo, wm);
  if (!same_hemisphere(wo, wi) || !is_density(pdf)) return std::nullopt;
  return BsdfSample{wi, reflectance(c) * facets.unshadowed(wo, wi), pdf, glossy, false, glossy};
}

Rgb Conductor::albedo() const {
  // Midpoint rule for 2 int F(c) c dc; its weights sum to one.
  constexpr int kPoints = 8;
  Rgb sum(0);
  for (int i = 0; i < kPoints; ++i) {
    const float c = (i + 0.5f) / kPoints;
    sum += reflectance(c) * (2 * c / kPoints);
  }
  return sum;
}

}  // namespace kaustik
