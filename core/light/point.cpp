// Sampling of point lights.

#include "core/light/point.h"

#include "core/sampling/warp.h"

namespace kaustik {

std::optional<LightSample> PointLight::sample_Li(const Point3& ref, const Point2& /*u*/) const {
  const Vector3 to_light = position - ref;
  const float distance2 = length_squared(to_light);
  if (!(distance2 > 0)) return std::nullopt;
  return LightSample{to_light / std::sqrt(distance2), I / distance2, 1, position, false};
}

std::optional<EmissionSample> PointLight::sample_Le(const Point2& /*u_pos*/, const Point2& u_dir,
                                                    EmissionMode /*mode*/) const {
  return EmissionSample{{position, sample_uniform_sphere(u_dir)}, power()};
}

}  // namespace kaustik
