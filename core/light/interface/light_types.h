#pragma once
// The interface of lights. A light is a value type; the concept LightType below lists what it must have:
//   static constexpr std::string_view kName
//     name of the type in `kaustik info`
//   bool is_delta() const
//     no ray can hit it (point, spot, distant)
//   std::optional<LightSample> sample_Li(x, u) const
//     light arriving at x, a point or a LightReceiver, before visibility; nothing if none can arrive
//   std::optional<EmissionSample> sample_Le(u_pos, u_dir, mode) const
//     start of a photon path
//   Rgb power() const
//     watts per channel
//   std::optional<LightBounds> bounds() const
//     where the light is and where it shines (core/light/interface/light_bounds.h); nothing for lights
//     without a position (distant, infinite)
//   double brightness(double scene_size) const
//     generous estimate of the radiance, in W/(m^2 sr), of surfaces that it lights in a scene of this radius
//     (metres); the range of exact sums follows from it
// Lights that rays hit when they leave the scene also have
//   Rgb Le(ray) const
//     radiance that the escaping ray meets
//   float pdf_Li(x, wi) const
//     density of sample_Li per solid angle
// and those that need the scene's bounding sphere have these data members, which finalize_scene sets:
//   Point3 scene_center; float scene_radius;
// Area lights have Le and pdf_Li for points on them.

#include <concepts>
#include <optional>
#include <string_view>

#include "core/math/error_bounds.h"
#include "core/math/ray.h"

namespace kaustik {

// The point at which light arrives, with the normal of its lit side.
struct LightReceiver {
  Point3 p{0};
  Normal3 n{0, 0, 1};
  bool two_sided = true;   // light from behind counts as well
  bool in_medium = false;  // light counts the same from everywhere: n is any direction
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

// LightType::brightness() of a light without extent whose greatest intensity is I (W/sr): at 2^-10 of the
// scene's radius.
inline double point_light_brightness(const Rgb& I, double scene_size) {
  return 0x1p20 * double(max_component(I)) / (scene_size * scene_size);
}

// Start of a photon path.
struct EmissionSample {
  Ray ray;      // unit direction; the origin is offset from the light's surface
  Rgb flux{0};  // Le |cos| / (pdf_pos pdf_dir): watts if this were the light's only photon
  // The photon comes from infinity and only passes through the origin: discard it if a ray traced backwards
  // from there hits anything.
  bool from_sky = false;
};

struct LightBounds;

template <class L>
concept SamplesPoints = requires(const L& light, const Point3& p, const Point2& u) {
  { light.sample_Li(p, u) } -> std::same_as<std::optional<LightSample>>;
};
template <class L>
concept SamplesReceivers = requires(const L& light, const LightReceiver& x, const Point2& u) {
  { light.sample_Li(x, u) } -> std::same_as<std::optional<LightSample>>;
};

// What every light must have; the meanings are at the top of this file.
template <class L>
concept LightType = (SamplesPoints<L> || SamplesReceivers<L>)&&requires(const L& light, const Point2& u,
                                                                        EmissionMode mode,
                                                                        double scene_size) {
  { L::kName } -> std::convertible_to<std::string_view>;
  { light.is_delta() } -> std::same_as<bool>;
  { light.sample_Le(u, u, mode) } -> std::same_as<std::optional<EmissionSample>>;
  { light.power() } -> std::same_as<Rgb>;
  { light.bounds() } -> std::same_as<std::optional<LightBounds>>;
  { light.brightness(scene_size) } -> std::same_as<double>;
};

}  // namespace kaustik
