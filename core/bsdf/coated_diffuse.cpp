// Evaluation and sampling of a coated diffuse surface; the tables of rough coats are in
// core/bsdf/microfacet/rough_coat.cpp.

#include "core/bsdf/coated_diffuse.h"

#include "core/bsdf/lambertian.h"

namespace kaustik {

namespace {

// One alpha for anisotropic facets, used for quantities summed over all directions.
float mean_alpha(const Ggx& facets) {
  return std::sqrt(facets.alpha_x * facets.alpha_y);
}

}  // namespace

CoatedDiffuse CoatedDiffuse::from_reflectance(const Rgb& rho, float eta, const Ggx& facets) {
  CoatedDiffuse bsdf;
  bsdf.eta = eta;
  double inside = fresnel_diffuse(1 / double(eta)), enters = 1 - fresnel_diffuse(double(eta));
  if (!facets.smooth() && eta != 1) {
    bsdf.facets = facets;
    const RoughTransmittance through(mean_alpha(facets), eta);
    inside = double(rough_inner_reflectance(mean_alpha(facets), eta));
    enters = 0;  // integrated with an 8-point rule
    for (int i = 0; i < 8; ++i) {
      const float z = (float(i) + 0.5f) / 8;
      enters += double(z / 4 * through(z));
    }
  }
  bsdf.enters = static_cast<float>(enters);
  const glm::dvec3 r(rho);
  bsdf.base = Rgb(r / (double(eta) * double(eta) * (1.0 - r * inside)));
  return bsdf;
}

float CoatedDiffuse::transmittance(const Vector3& w) const {
  if (facets.smooth()) return 1 - fresnel_dielectric(abs_cos_theta(w), eta);
  return rough_transmittance(abs_cos_theta(w), mean_alpha(facets), eta);
}

Rgb CoatedDiffuse::f(const Vector3& wo, const Vector3& wi) const {
  if (!same_hemisphere(wo, wi)) return Rgb(0);
  const Rgb from_base = base * (kInvPi * (transmittance(wo) * transmittance(wi)));
  return coat_is_diffuse() ? from_base + f_coat(wo, wi) : from_base;
}

Coat CoatedDiffuse::coat() const {
  return {eta, facets.smooth() ? 0 : mean_alpha(facets)};
}

CoatedDiffuse::Seen::Seen(const CoatedDiffuse& bsdf, const Vector3& wo)
    : bsdf_(&bsdf),
      wo_(wo),
      from_base_(bsdf.base * (kInvPi * bsdf.transmittance(wo))),
      through_(bsdf.coat()) {}

std::optional<SeparatedF> CoatedDiffuse::separated(const Vector3& wo) const {
  if (coat_is_diffuse()) return std::nullopt;
  return SeparatedF{base * transmittance(wo), coat()};
}

float CoatedDiffuse::pdf(const Vector3& wo, const Vector3& wi) const {
  if (!same_hemisphere(wo, wi)) return 0;
  const float of_base = cosine_hemisphere_pdf(abs_cos_theta(wi));
  if (!coat_is_diffuse()) return of_base;
  const float p = share_of_coat(wo);
  return p * pdf_coat(wo, wi) + (1 - p) * of_base;
}

Rgb CoatedDiffuse::f_glossy(const Vector3& wo, const Vector3& wi) const {
  return lobes().glossy && same_hemisphere(wo, wi) ? Rgb(f_coat(wo, wi)) : Rgb(0);
}

float CoatedDiffuse::pdf_glossy(const Vector3& wo, const Vector3& wi) const {
  return lobes().glossy && same_hemisphere(wo, wi) ? pdf_coat(wo, wi) : 0;
}

float CoatedDiffuse::f_coat(const Vector3& wo, const Vector3& wi) const {
  const Vector3 wm = glm::normalize(wo + wi);
  return fresnel_dielectric(abs_dot(wo, wm), eta) * facets.D(wm) * facets.masking(wo, wi);
}

float CoatedDiffuse::pdf_coat(const Vector3& wo, const Vector3& wi) const {
  return facets.reflection_pdf(wo, glm::normalize(wo + wi));
}

float CoatedDiffuse::share_of_coat(const Vector3& wo) const {
  const float T = transmittance(wo), below = max_component(base) * T * enters;
  return 1 - T + below > 0 ? (1 - T) / (1 - T + below) : 1;
}

std::optional<BsdfSample> CoatedDiffuse::sample_coat(const Vector3& wo, const Point2& u) const {
  if (wo.z == 0) return std::nullopt;
  if (facets.smooth()) {
    const float F = fresnel_dielectric(abs_cos_theta(wo), eta);
    if (!(F > 0)) return std::nullopt;
    return BsdfSample{{-wo.x, -wo.y, wo.z}, Rgb(F), 1, true, false};
  }
  const Vector3 wm = facets.sample_visible(wo, u);
  const float c = glm::dot(wo, wm), pdf = facets.reflection_pdf(wo, wm);
  const Vector3 wi = 2 * c * wm - wo;
  if (!same_hemisphere(wo, wi) || !is_density(pdf)) return std::nullopt;
  const Rgb weight(fresnel_dielectric(std::abs(c), eta) * facets.unshadowed(wo, wi));
  return BsdfSample{wi, weight, pdf, true, false, true};
}

std::optional<BsdfSample> CoatedDiffuse::sample_base(const Vector3& wo, const Point2& u) const {
  const auto wi = sample_cosine_side_of(wo, u);
  if (!wi) return std::nullopt;
  const float through = transmittance(wo) * transmittance(*wi);
  return BsdfSample{*wi, base * through, cosine_hemisphere_pdf(abs_cos_theta(*wi)), false, false};
}

std::optional<BsdfSample> CoatedDiffuse::sample_specular(const Vector3& wo, float /*uc*/, const Point2& u,
                                                         TransportMode /*mode*/) const {
  return sample_coat(wo, u);
}

std::optional<BsdfSample> CoatedDiffuse::sample_diffuse(const Vector3& wo, float uc, const Point2& u,
                                                        TransportMode /*mode*/) const {
  if (!coat_is_diffuse()) return sample_base(wo, u);
  // The directions of both lobes overlap, so the sample has a common density.
  const auto s = uc < share_of_coat(wo) ? sample_coat(wo, u) : sample_base(wo, u);
  if (!s) return std::nullopt;
  const float density = pdf(wo, s->wi);
  return BsdfSample{s->wi, f(wo, s->wi) * (abs_cos_theta(s->wi) / density), density, false, false};
}

std::optional<BsdfSample> CoatedDiffuse::sample_f(const Vector3& wo, float uc, const Point2& u,
                                                  TransportMode mode) const {
  if (coat_is_diffuse()) return sample_diffuse(wo, uc, u, mode);
  const float p = share_of_coat(wo);
  auto s = uc < p ? sample_coat(wo, u) : sample_base(wo, u);
  if (s) s->weight /= uc < p ? p : 1 - p;
  return s;
}

Rgb CoatedDiffuse::albedo() const {
  const float F = static_cast<float>(fresnel_diffuse(double(eta)));
  return Rgb(F) + base * (enters * enters);
}

}  // namespace kaustik
