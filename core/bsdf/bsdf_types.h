#pragma once
// The interface of BSDFs.
//
// A BSDF has up to two parts. The diffuse part (`broad`) consists of all lobes that are wide enough to gather
// photons under, such as Lambertian ones and those of rough metal. The specular part is followed by photons
// and camera paths: delta lobes, and glossy lobes, whose width is finite but too small to gather under
// (Ggx::is_narrow). The part that scatters a path decides its class
// (docs/decisions/020-one-owner-per-path.md).
//
// A BSDF is a value type with these members. Directions are in the local shading frame (z = ns); wo and wi
// have unit length and point away from the surface, and wo.z < 0 means the back side:
//   Lobes lobes() const
//     parts that this value has
//   Rgb f(wo, wi) const
//     value of the diffuse part in 1/sr, without the cosine, for radiance that leaves towards wo
//   float pdf(wo, wi) const
//     density per solid angle of the diffuse samples of sample_f
//   std::optional<BsdfSample> sample_f(wo, uc, u, mode) const
//     uc in [0, 1) chooses the lobe, u in [0, 1)^2 the direction; nothing if no light is scattered
//   Rgb albedo() const
//     hemispherical reflectance, for the AOV
//   static constexpr std::string_view kName
// and, where they apply:
//   f_glossy, pdf_glossy
//     like f and pdf, for the glossy lobes
//   sample_broad, sample_specular
//     like sample_f, for one part alone, if a value can have both
//   static constexpr bool kTransmits
//     the diffuse part transmits light

#include <optional>
#include <string_view>

#include "core/math/vec.h"

namespace kaustik {

// Camera paths carry radiance, photon paths carry importance (Veach's adjoint). Refraction scales radiance by
// 1/eta^2 (Pharr 2023, section 9.5.2), but not flux.
enum class TransportMode { kRadiance, kImportance };

struct Lobes {
  bool broad = false;
  bool specular = false;
  bool glossy = false;  // the specular part has finite width, so lights can be sampled there
};
inline constexpr Lobes kBroadLobes{true, false, false}, kDeltaLobes{false, true, false},
    kGlossyLobes{false, true, true};

struct BsdfSample {
  Vector3 wi{0};  // local frame
  Rgb weight{0};  // f |cos wi| / density; for delta lobes the lobe's factor over its probability
  // Density per solid angle, given the chosen part; for delta lobes the probability of the lobe.
  float pdf = 0;
  bool specular = false;  // whether the specular part was chosen
  bool transmission = false;
  bool glossy = false;  // specular, but not a delta lobe
};

// Whether a density is usable. Lobes evaluated at their very edge may overflow or underflow; such samples are
// dropped.
inline bool is_density(float pdf) {
  return pdf > 0 && pdf < kInfinity;
}
inline float cos_theta(const Vector3& w) {
  return w.z;
}
inline float abs_cos_theta(const Vector3& w) {
  return std::abs(w.z);
}
inline bool same_hemisphere(const Vector3& a, const Vector3& b) {
  return a.z * b.z > 0;
}

}  // namespace kaustik
