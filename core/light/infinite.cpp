#include "core/light/infinite.h"

#include "core/math/frame.h"
#include "core/sampling/warp.h"

namespace kaustik {

std::optional<LightSample> InfiniteLight::sample_Li(const Point3& /*ref*/, const Point2& u) const {
  return LightSample{sample_uniform_sphere(u), L, kUniformSpherePdf, Point3(0), true};
}

float InfiniteLight::pdf_Li() const {
  return kUniformSpherePdf;
}

std::optional<EmissionSample> InfiniteLight::sample_Le(const Point2& u_pos, const Point2& u_dir,
                                                       EmissionMode /*mode*/) const {
  if (!(scene_radius > 0)) return std::nullopt;
  const Vector3 to_light = sample_uniform_sphere(u_dir);
  const Point2 disk = sample_uniform_disk_concentric(u_pos);
  const Vector3 offset = Frame::from_z(to_light).to_world({disk.x, disk.y, 1});
  return EmissionSample{{scene_center + scene_radius * offset, -to_light}, power()};
}

}  // namespace kaustik
