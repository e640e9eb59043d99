#pragma once
// What every BSDF has in common.
//
// Each has up to two parts. The broad lobes are those under which photons are gathered. The specular ones are
// followed, by photons and by camera paths: delta lobes, and glossy lobes, whose width is finite but too
// small to gather under (Ggx::is_narrow). Which part scatters decides the class of a path:
// docs/architecture.md, "One owner per path".
//
// A BSDF is a value type with these members, all in the local shading frame (z = ns, wo and wi unit and
// pointing away from the surface; wo.z < 0 means the back side):
//   Lobes lobes() const                    which parts this value has
//   Rgb f(wo, wi) const                    value of the broad lobes in 1/sr, without the cosine, for radiance
//                                          that leaves towards wo
//   float pdf(wo, wi) const                density of the broad samples of sample_f per solid angle
//   std::optional<BsdfSample> sample_f(wo, uc, u, mode) const   nothing when no light is scattered
//   Rgb albedo() const                     hemispherical reflectance for the AOV
//   static constexpr std::string_view kName
// and where they are of use:
//   f_glossy, pdf_glossy                   as f and pdf, of the glossy lobes
//   sample_broad, sample_specular          as sample_f, of one part alone, for values that have both
//   static constexpr bool kTransmits       broad lobes let light through

#include <optional>
#include <string_view>

#include "core/math/vec.h"

namespace kaustik {

// Radiance travels along camera paths, importance (Veach's adjoint) along photon paths. Refraction scales
// radiance by 1/eta^2 (pharr 2023, 9.5.2) but not flux.
enum class TransportMode { kRadiance, kImportance };

struct Lobes {
  bool broad = false;
  bool specular = false;
  bool glossy = false;  // the specular part has finite width: lights can be sampled there
};
inline constexpr Lobes kBroadLobes{true, false, false}, kDeltaLobes{false, true, false},
    kGlossyLobes{false, true, true};

struct BsdfSample {
  Vector3 wi{0};  // local frame
  Rgb weight{0};  // f |cos wi| / density; for delta lobes the lobe's factor over its probability
  // Per solid angle, given the part that was chosen; probability of the lobe for delta lobes.
  float pdf = 0;
  bool specular = false;  // the part that was chosen
  bool transmission = false;
  bool glossy = false;  // specular, but no delta lobe
};

// Overflow and underflow of lobes that are met at their very edge: such samples are dropped.
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
