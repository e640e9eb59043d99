#pragma once
// An ideal mirror.

#include "core/bsdf/bsdf_types.h"

namespace kaustik {

// Ideal mirror with constant reflectance on both sides.
struct Mirror {
  static constexpr std::string_view kName = "mirror";
  static constexpr bool kTransmits = false;
  static constexpr bool kLitFromOneSide = false;
  static constexpr bool kDrawsLobe = true;
  static constexpr bool kScattersAboutN = false;

  Rgb reflectance{1};

  static constexpr bool anisotropic() { return false; }
  static constexpr Lobes lobes() { return kDeltaLobes; }
  Rgb f(const Vector3& /*wo*/, const Vector3& /*wi*/) const { return Rgb(0); }
  float pdf(const Vector3& /*wo*/, const Vector3& /*wi*/) const { return 0; }
  std::optional<BsdfSample> sample_f(const Vector3& wo, float /*uc*/, const Point2& /*u*/,
                                     TransportMode /*mode*/) const {
    if (wo.z == 0) return std::nullopt;
    return BsdfSample{{-wo.x, -wo.y, wo.z}, reflectance, 1, true, false};
  }
  Rgb albedo() const { return reflectance; }
};

}  // namespace kaustik
