// Sampling of spot lights.

#include "core/light/spot.h"

#include "core/sampling/warp.h"

namespace kaustik {
namespace {

// Inverts the cumulative distribution 2 x^3 - x^4 of the normalised smoothstep by Newton's method. The
// function is convex on [0, 1] and cbrt(u) lies to the right of the root, so the iteration descends
// monotonically; four steps reach float precision.
float sample_smoothstep(float u) {
  if (!(u > 0)) return 0;
  float x = std::cbrt(u);
  for (int i = 0; i < 5; ++i) {
    x -= (x * x * x * (2 - x) - u) / (x * x * (6 - 4 * x));
  }
  return std::clamp(x, 0.0f, 1.0f);
}

}  // namespace

Rgb SpotLight::intensity(float cos_theta) const {
  if (cos_theta >= cos_falloff_start) return I;
  if (cos_theta <= cos_total_width) return Rgb(0);
  const float x = (cos_theta - cos_total_width) / (cos_falloff_start - cos_total_width);
  return I * (x * x * (3 - 2 * x));
}

std::optional<LightSample> SpotLight::sample_Li(const Point3& ref, const Point2& /*u*/) const {
  return sample_point_light(position, ref, [&](const Vector3& w) { return intensity(glm::dot(w, frame.z)); });
}

std::optional<EmissionSample> SpotLight::sample_Le(const Point2& /*u_pos*/, const Point2& u_dir,
                                                   EmissionMode /*mode*/) const {
  // Sample in proportion to the intensity: per 2 pi, the full cone holds (1 - cos_falloff_start) of it, and
  // the falloff ring half of (cos_falloff_start - cos_total_width).
  const float cone = 1 - cos_falloff_start;
  const float ring = cos_falloff_start - cos_total_width;
  const float in_cone = cone / (cone + 0.5f * ring);
  if (!(in_cone >= 0)) return std::nullopt;  // the cone has no solid angle
  float one_minus_cos;
  if (u_dir.x < in_cone) {
    one_minus_cos = u_dir.x / in_cone * cone;
  } else {
    one_minus_cos = 1 - (cos_total_width + ring * sample_smoothstep((1 - u_dir.x) / (1 - in_cone)));
  }
  const Vector3 local = sample_uniform_cone({1, u_dir.y}, one_minus_cos);
  return EmissionSample{{position, frame.to_world(local)}, power()};
}

Rgb SpotLight::power() const {
  const float cone = 1 - cos_falloff_start;
  const float ring = cos_falloff_start - cos_total_width;
  return I * (2 * kPi * (cone + 0.5f * ring));
}

std::optional<LightBounds> SpotLight::bounds() const {
  LightBounds b = bounds_of_point(position, I);
  b.w = frame.z;
  b.cos_o = cos_total_width;
  b.cos_e = 1;
  return b;
}

}  // namespace kaustik
