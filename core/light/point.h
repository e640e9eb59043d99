#pragma once
// Isotropic point lights.

#include "core/light/light_types.h"

namespace kaustik {

// Isotropic point light with radiant intensity I (W/sr).
struct PointLight {
  static constexpr bool kDelta = true;
  static constexpr std::string_view kName = "point";

  Point3 position{0};
  Rgb I{1};

  std::optional<LightSample> sample_Li(const Point3& ref, const Point2& u) const;
  std::optional<EmissionSample> sample_Le(const Point2& u_pos, const Point2& u_dir, EmissionMode mode) const;
  Rgb power() const { return 4 * kPi * I; }
};

}  // namespace kaustik
