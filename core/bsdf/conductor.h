#pragma once
#include "core/bsdf/bsdf_types.h"

namespace kaustik {

// Smooth metal: specular reflection with the conductor Fresnel factor, both sides (pharr 2023, 9.4).
struct Conductor {
  static constexpr bool kSpecular = true;
  static constexpr std::string_view kName = "conductor";

  Rgb eta{1}, k{1};

  Rgb f(const Vector3& /*wo*/, const Vector3& /*wi*/) const { return Rgb(0); }
  float pdf(const Vector3& /*wo*/, const Vector3& /*wi*/) const { return 0; }
  std::optional<BsdfSample> sample_f(const Vector3& wo, float uc, const Point2& u, TransportMode mode) const;
  // Reflectance of the whole hemisphere under uniform light, by an 8-point rule: for previews, not transport.
  Rgb albedo() const;

 private:
  Rgb reflectance(float cos_theta_i) const;
};

}  // namespace kaustik
