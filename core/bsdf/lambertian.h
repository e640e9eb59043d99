#pragma once
// Ideal diffuse reflection.

#include "core/bsdf/bsdf_types.h"
#include "core/sampling/warp.h"

namespace kaustik {

// Cosine-distributed direction on the side of wo, used by several diffuse BSDFs. Nothing at exactly grazing
// angles.
inline std::optional<Vector3> sample_cosine_side_of(const Vector3& wo, const Point2& u) {
  Vector3 wi = sample_cosine_hemisphere(u);
  if (wo.z < 0) wi.z = -wi.z;
  if (!same_hemisphere(wo, wi)) return std::nullopt;
  return wi;
}

// Ideal diffuse reflection on both sides: f = reflectance / pi.
struct Lambertian {
  static constexpr std::string_view kName = "diffuse";
  static constexpr bool kTransmits = false;
  static constexpr bool kLitFromOneSide = true;
  static constexpr bool kDrawsLobe = false;
  static constexpr bool kScattersAboutN = true;

  Rgb reflectance{0.5f};

  static constexpr bool anisotropic() { return false; }
  static constexpr Lobes lobes() { return kDiffuseLobes; }
  Rgb f(const Vector3& wo, const Vector3& wi) const {
    return same_hemisphere(wo, wi) ? reflectance * kInvPi : Rgb(0);
  }
  float pdf(const Vector3& wo, const Vector3& wi) const {
    return same_hemisphere(wo, wi) ? cosine_hemisphere_pdf(abs_cos_theta(wi)) : 0;
  }
  std::optional<BsdfSample> sample_f(const Vector3& wo, float /*uc*/, const Point2& u,
                                     TransportMode /*mode*/) const {
    const auto wi = sample_cosine_side_of(wo, u);
    if (!wi) return std::nullopt;
    return BsdfSample{*wi, reflectance, cosine_hemisphere_pdf(abs_cos_theta(*wi)), false, false};
  }
  Rgb pi_f(bool transmitted) const { return transmitted ? Rgb(0) : reflectance; }
  Rgb albedo() const { return reflectance; }
};

}  // namespace kaustik
