#pragma once
// Diffuse reflection and transmission by a thin sheet.

#include "core/bsdf/lambertian.h"

namespace kaustik {

// A sheet that scatters light diffusely to both sides, like paper or a leaf: f = reflectance / pi on the side
// of wo, and transmittance / pi on the other side (Pharr 2023, section 9.2.1, "DiffuseTransmissionBxDF").
struct DiffuseTransmission {
  static constexpr std::string_view kName = "diffusetransmission";
  static constexpr bool kTransmits = true;
  static constexpr bool kLitFromOneSide = false;
  static constexpr bool kDrawsLobe = true;
  static constexpr bool kScattersAboutN = false;

  Rgb reflectance{0.25f}, transmittance{0.25f};  // their sum at most one

  static constexpr bool anisotropic() { return false; }
  static constexpr Lobes lobes() { return kDiffuseLobes; }
  Rgb f(const Vector3& wo, const Vector3& wi) const {
    const float product = wo.z * wi.z;
    return product == 0 ? Rgb(0) : (product > 0 ? reflectance : transmittance) * kInvPi;
  }
  float pdf(const Vector3& wo, const Vector3& wi) const {
    const float product = wo.z * wi.z, r = share_reflected();
    return product == 0 ? 0 : (product > 0 ? r : 1 - r) * cosine_hemisphere_pdf(abs_cos_theta(wi));
  }
  std::optional<BsdfSample> sample_f(const Vector3& wo, float uc, const Point2& u,
                                     TransportMode /*mode*/) const {
    auto wi = sample_cosine_side_of(wo, u);
    if (!wi) return std::nullopt;
    const float r = share_reflected(), density = cosine_hemisphere_pdf(abs_cos_theta(*wi));
    if (uc < r) return BsdfSample{*wi, reflectance / r, r * density, false, false};
    if (!(r < 1)) return std::nullopt;
    wi->z = -wi->z;
    return BsdfSample{*wi, transmittance / (1 - r), (1 - r) * density, false, true};
  }
  Rgb pi_f(bool transmitted) const { return transmitted ? transmittance : reflectance; }
  Rgb albedo() const { return reflectance; }

 private:
  // Share of the samples that are reflected; one where nothing is scattered.
  float share_reflected() const {
    const float r = max_component(reflectance), t = max_component(transmittance);
    return t > 0 ? r / (r + t) : 1;
  }
};

}  // namespace kaustik
