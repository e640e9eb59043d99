#pragma once
#include "core/light/light_types.h"

namespace kaustik {

// Constant radiance L from every direction. The builder sets the scene's bounding sphere.
struct InfiniteLight {
  static constexpr bool kDelta = false;
  static constexpr std::string_view kName = "infinite";

  Rgb L{1};
  Point3 scene_center{0};
  float scene_radius = 0;

  Rgb Le() const { return L; }
  std::optional<LightSample> sample_Li(const Point3& ref, const Point2& u) const;
  float pdf_Li() const;  // of sample_Li, uniform over the sphere of directions
  std::optional<EmissionSample> sample_Le(const Point2& u_pos, const Point2& u_dir, EmissionMode mode) const;
  // Flux that enters the scene's bounding sphere.
  Rgb power() const { return 4 * kPi * kPi * scene_radius * scene_radius * L; }
};

}  // namespace kaustik
