#pragma once
// The interface of lights. A light is a value type with these members:
//   std::optional<LightSample> sample_Li(ref, u) const
//     light arriving at a point (or at a LightReceiver); nothing if none can arrive
//   std::optional<EmissionSample> sample_Le(u_pos, u_dir, mode) const
//     start of a photon path
//   Rgb power() const
//     watts per channel
//   static constexpr bool kDelta
//     no ray can hit it (point, spot, distant)
//   static constexpr std::string_view kName
// Area and infinite lights also have Le, the radiance towards a viewer, and pdf_Li, the density of sample_Li
// per solid angle.

#include <optional>
#include <string_view>

#include "core/math/error_bounds.h"
#include "core/math/ray.h"

namespace kaustik {

// The point at which light arrives, with the normal of its lit side. two_sided: light from behind counts as
// well.
struct LightReceiver {
  Point3 p{0};
  Normal3 n{0, 0, 1};
  bool two_sided = true;
};

// How area lights choose the directions of photons.
enum class EmissionMode {
  kCosine,       // pdf cos/pi: equal flux per photon
  kUniformAngle  // as in the lecture: theta and phi uniform, weighted by cos sin(theta) pi
};

// Light arriving at a point, before visibility.
struct LightSample {
  Vector3 wi{0};  // unit, from the point to the light
  Rgb Li{0};      // radiance; for delta lights intensity / distance^2 or irradiance
  float pdf = 0;  // per solid angle at the point; 1 for delta lights
  // The sampled point, already offset from the light's surface towards the receiver; unused for infinite
  // lights.
  Point3 p_light{0};
  bool infinite = false;  // no end point: trace to t_max = infinity
};

// Samples a light without extent; intensity(w) is W/sr in the unit direction w away from the light.
template <class Intensity>
std::optional<LightSample> sample_point_light(const Point3& position, const Point3& ref,
                                              const Intensity& intensity) {
  const Vector3 to_light = position - ref;
  const float distance2 = length_squared(to_light);
  if (!(distance2 > 0)) return std::nullopt;
  const Vector3 wi = to_light / std::sqrt(distance2);
  const Rgb Li = intensity(-wi) / distance2;
  if (is_black(Li)) return std::nullopt;
  return LightSample{wi, Li, 1, position, false};
}

// Start of a photon path.
struct EmissionSample {
  Ray ray;      // unit direction; the origin is offset from the light's surface
  Rgb flux{0};  // Le |cos| / (pdf_pos pdf_dir): watts if this were the light's only photon
  // The photon comes from infinity and only passes through the origin: discard it if a ray traced backwards
  // from there hits anything.
  bool from_sky = false;
};

}  // namespace kaustik
