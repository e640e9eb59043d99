#pragma once
// Spot lights, as in pbrt-v4.

#include "core/light/interface/light_bounds.h"
#include "core/math/frame.h"

namespace kaustik {

// Spot light: intensity I within acos(cos_falloff_start) of its axis, falling with pbrt's smoothstep to zero
// at acos(cos_total_width).
struct SpotLight {
  static constexpr std::string_view kName = "spot";

  Point3 position{0};
  Frame frame;  // z is the axis
  Rgb I{1};
  float cos_falloff_start = 1, cos_total_width = 0;

  static constexpr bool is_delta() { return true; }
  Rgb intensity(float cos_theta) const;
  std::optional<LightSample> sample_Li(const Point3& ref, const Point2& u) const;
  std::optional<EmissionSample> sample_Le(const Point2& u_pos, const Point2& u_dir, EmissionMode mode) const;
  Rgb power() const;
  std::optional<LightBounds> bounds() const;
  double brightness(double scene_size) const { return point_light_brightness(I, scene_size); }
};

}  // namespace kaustik
