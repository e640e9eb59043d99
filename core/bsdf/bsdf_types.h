#pragma once
// What every BSDF has in common. A BSDF is a value type with these members, all in the local shading frame (z
// = ns, wo and wi unit and pointing away from the surface; wo.z < 0 means the back side):
//   Rgb f(wo, wi) const                    value of the BSDF in 1/sr, without the cosine; zero for delta
//   lobes float pdf(wo, wi) const                density of sample_f per solid angle; zero for delta lobes
//   std::optional<BsdfSample> sample_f(wo, uc, u, mode) const   nothing when no light is scattered
//   Rgb albedo() const                     hemispherical reflectance for the AOV and for Russian roulette
//   static constexpr bool kSpecular        only delta lobes: photons are not stored there
//   static constexpr std::string_view kName

#include <optional>
#include <string_view>

#include "core/math/vec.h"

namespace kaustik {

// Radiance travels along camera paths, importance (Veach's adjoint) along photon paths. Refraction scales
// radiance by 1/eta^2 (pharr 2023, 9.5.2) but not flux.
enum class TransportMode { kRadiance, kImportance };

struct BsdfSample {
  Vector3 wi{0};  // local frame
  Rgb weight{0};  // f |cos wi| / pdf; for delta lobes the lobe's factor over its probability
  float pdf = 0;  // per solid angle; probability of the lobe when specular
  bool specular = false;
  bool transmission = false;
};

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
