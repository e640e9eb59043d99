// Sampling of goniometric lights.

#include "core/light/goniometric.h"

namespace kaustik {

std::optional<LightSample> GoniometricLight::sample_Li(const Point3& ref, const Point2& /*u*/) const {
  return sample_point_light(position, ref, [&](const Vector3& w) { return intensity(w); });
}

std::optional<EmissionSample> GoniometricLight::sample_Le(const Point2& /*u_pos*/, const Point2& u_dir,
                                                          EmissionMode /*mode*/) const {
  const DirectionMap::Sample s = map->sample(u_dir);
  if (!(s.value.x > 0)) return std::nullopt;
  return EmissionSample{{position, to_world * s.w}, I * (s.value.x / s.pdf)};
}

}  // namespace kaustik
