#pragma once
// A thin pane of glass.

#include "core/bsdf/bsdf_types.h"
#include "core/bsdf/lobe_tints.h"
#include "core/bsdf/microfacet/fresnel.h"

namespace kaustik {

// A pane so thin that light leaves where it entered: reflection and straight transmission, including all
// inner reflections (Pharr 2023, section 9.5.4).
struct ThinDielectric {
  static constexpr std::string_view kName = "thindielectric";
  static constexpr bool kTransmits = false;
  static constexpr bool kLitFromOneSide = false;
  static constexpr bool kDrawsLobe = true;
  static constexpr bool kScattersAboutN = false;

  float eta = 1.5f;  // of the pane relative to its surroundings
  LobeTints tints{};

  static constexpr bool anisotropic() { return false; }
  static constexpr Lobes lobes() { return kDeltaLobes; }
  Rgb f(const Vector3& /*wo*/, const Vector3& /*wi*/) const { return Rgb(0); }
  float pdf(const Vector3& /*wo*/, const Vector3& /*wi*/) const { return 0; }
  std::optional<BsdfSample> sample_f(const Vector3& wo, float uc, const Point2& /*u*/,
                                     TransportMode /*mode*/) const {
    if (wo.z == 0) return std::nullopt;
    // R + T^2 R + T^2 R^3 + ..., with T = 1 - R.
    const float R = fresnel_dielectric(std::abs(wo.z), eta), reflectance = 2 * R / (1 + R);
    if (tints.tinted()) return sample_tinted(wo, uc, reflectance);
    if (uc < reflectance) return BsdfSample{{-wo.x, -wo.y, wo.z}, Rgb(1), reflectance, true, false};
    return BsdfSample{-wo, Rgb(1), 1 - reflectance, true, true};
  }
  Rgb albedo() const { return tints.tinted() ? tints.albedo(eta) : Rgb(1); }

 private:
  std::optional<BsdfSample> sample_tinted(const Vector3& wo, float uc, float fresnel) const {
    const auto [reflection, transmission] = tints.chances(fresnel);
    if (uc < reflection)
      return BsdfSample{
          {-wo.x, -wo.y, wo.z}, tints.weight(false, fresnel, reflection), reflection, true, false};
    if (!(transmission > 0)) return std::nullopt;
    return BsdfSample{-wo, tints.weight(true, fresnel, transmission), transmission, true, true};
  }
};

}  // namespace kaustik
