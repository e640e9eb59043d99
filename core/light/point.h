#pragma once
// Isotropic point lights.

#include "core/light/interface/light_bounds.h"

namespace kaustik {

// Isotropic point light with radiant intensity I (W/sr).
struct PointLight {
  static constexpr std::string_view kName = "point";

  Point3 position{0};
  Rgb I{1};

  static constexpr bool is_delta() { return true; }
  std::optional<LightSample> sample_Li(const Point3& ref, const Point2& u) const;
  std::optional<EmissionSample> sample_Le(const Point2& u_pos, const Point2& u_dir, EmissionMode mode) const;
  Rgb power() const { return 4 * kPi * I; }
  std::optional<LightBounds> bounds() const { return bounds_of_point(position, I); }
  double brightness(double scene_size) const { return point_light_brightness(I, scene_size); }
};

}  // namespace kaustik
