#pragma once
// Rough diffuse reflection by the Oren-Nayar model.

#include "core/bsdf/lambertian.h"

namespace kaustik {

// Rough diffuse reflection by V-shaped facets, on both sides (Oren and Nayar 1994, equation 30, the
// qualitative model): f = reflectance/pi (A + B max(0, cos(phi_i - phi_o)) sin(alpha) tan(beta)), where alpha
// is the larger and beta the smaller of the two polar angles. Not modelled: interreflection between facets.
struct OrenNayar {
  static constexpr std::string_view kName = "orennayar";
  static constexpr bool kTransmits = false;
  static constexpr bool kLitFromOneSide = true;
  static constexpr bool kDrawsLobe = false;
  static constexpr bool kScattersAboutN = true;

  Rgb reflectance{0.5f};
  float A = 1, B = 0;  // computed from sigma, the standard deviation of the facets' slope angle

  // The directional albedo rises to reflectance (A + B/2) at grazing wo, which exceeds one for nearly white
  // surfaces with small sigma (by at most 1.5 %). Such reflectances are lowered so that no energy is created.
  static OrenNayar from_sigma_degrees(const Rgb& reflectance, float sigma_degrees);

  static constexpr bool anisotropic() { return false; }
  static constexpr Lobes lobes() { return kDiffuseLobes; }
  Rgb f(const Vector3& wo, const Vector3& wi) const {
    return same_hemisphere(wo, wi) ? reflectance * (shape_factor(wo, wi) * kInvPi) : Rgb(0);
  }
  float pdf(const Vector3& wo, const Vector3& wi) const {
    return same_hemisphere(wo, wi) ? cosine_hemisphere_pdf(abs_cos_theta(wi)) : 0;
  }
  std::optional<BsdfSample> sample_f(const Vector3& wo, float /*uc*/, const Point2& u,
                                     TransportMode /*mode*/) const {
    const auto wi = sample_cosine_side_of(wo, u);
    if (!wi) return std::nullopt;
    const float pdf_wi = cosine_hemisphere_pdf(abs_cos_theta(*wi));
    return BsdfSample{*wi, reflectance * shape_factor(wo, *wi), pdf_wi, false, false};
  }
  Rgb albedo() const;

 private:
  // A + B max(0, cos(phi_i - phi_o)) sin(alpha) tan(beta), computed without angles: the cosine of the
  // azimuths times both sines is the dot product of the tangential parts, and tan(beta) divides by the larger
  // cosine.
  float shape_factor(const Vector3& wo, const Vector3& wi) const {
    const float tangential = std::max(0.0f, wo.x * wi.x + wo.y * wi.y);
    return A + B * tangential / std::max(abs_cos_theta(wo), abs_cos_theta(wi));
  }
};

}  // namespace kaustik
