#pragma once
// Distant lights: parallel light from one direction.

#include "core/light/interface/light_bounds.h"
#include "core/math/bounds.h"

namespace kaustik {

// Parallel light with irradiance L on a plane facing it. finalize_scene sets the scene's bounding sphere.
struct DistantLight {
  static constexpr std::string_view kName = "distant";

  Vector3 to_light{0, 0, 1};  // unit
  Rgb L{1};
  Point3 scene_center{0};
  float scene_radius = 0;

  static constexpr bool is_delta() { return true; }
  std::optional<LightSample> sample_Li(const Point3& ref, const Point2& u) const;
  std::optional<EmissionSample> sample_Le(const Point2& u_pos, const Point2& u_dir, EmissionMode mode) const;
  Rgb power() const { return kPi * scene_radius * scene_radius * L; }
  std::optional<LightBounds> bounds() const { return std::nullopt; }
  double brightness(double /*scene_size*/) const { return double(max_component(L)); }
};

}  // namespace kaustik
