#pragma once
// What a flux is, and Veach's correction of photons' flux for shading normals.

#include "core/geometry/interaction.h"

namespace kaustik::photon::detail {

inline bool is_valid_flux(const Rgb& flux) {
  return is_finite(flux) && flux.x >= 0 && flux.y >= 0 && flux.z >= 0;
}

// Shading normals. With ns the camera path's measurement is defined as (Veach 1997, section 5.3)
//   Lo(wo) = integral f(wo, wi) Li(wi) |wi.ns| dwi,
// while photons that cross the geometric surface from wi bring the flux dPhi = Li |wi.n| dwi dA. Hence
//   Lo(wo) = 1/dA sum f(wo, wi) dPhi c(wi)   with   c(w) = |w.ns| / |w.n|,
// so a deposit carries c(wi). A photon that goes on in wi carries Lo(wi) |wi.n| dwi dA: with sample_f's
// weight f |wi.ns| / pdf the factor left is c(wo) / c(wi), where wo points back to where the photon came
// from. Both hold for delta lobes too, whose f has 1/|wi.ns|. Directions on different sides of n and ns carry
// nothing (no light leaks), as on camera paths.
//
// cos_ns = w.ns. Returns c(w), zero when the sides differ; exactly one when ns equals n.
inline float shading_correction(const SurfaceInteraction& si, const Vector3& w, float cos_ns) {
  const float cos_n = glm::dot(w, si.n);
  if (!(cos_n * cos_ns > 0)) return 0;
  return si.n == si.ns ? 1.0f : cos_ns / cos_n;
}

}  // namespace kaustik::photon::detail
