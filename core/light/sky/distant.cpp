// Sampling of distant lights.

#include "core/light/sky/distant.h"

#include "core/math/frame.h"
#include "core/sampling/warp.h"

namespace kaustik {

std::optional<LightSample> DistantLight::sample_Li(const Point3& /*ref*/, const Point2& /*u*/) const {
  return LightSample{to_light, L, 1, Point3(0), true};
}

std::optional<EmissionSample> DistantLight::sample_Le(const Point2& u_pos, const Point2& /*u_dir*/,
                                                      EmissionMode /*mode*/) const {
  if (!(scene_radius > 0)) return std::nullopt;
  const Point2 disk = sample_uniform_disk_concentric(u_pos);
  const Vector3 offset = Frame::from_z(to_light).to_world({disk.x, disk.y, 1});
  return EmissionSample{{scene_center + scene_radius * offset, -to_light}, power()};
}

}  // namespace kaustik
