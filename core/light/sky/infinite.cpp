// Sampling of environment light.

#include "core/light/sky/infinite.h"

#include "core/light/sky/even_light.h"
#include "core/math/frame.h"
#include "core/sampling/warp.h"

namespace kaustik {
namespace {

// A ray from infinity with a uniform origin on the disk that covers the scene's bounding sphere as seen from
// `to_light`.
Ray ray_into_scene(const Point3& scene_center, float scene_radius, const Vector3& to_light, const Point2& u) {
  const Point2 disk = sample_uniform_disk_concentric(u);
  const Vector3 offset = Frame::from_z(to_light).to_world({disk.x, disk.y, 1});
  return {scene_center + scene_radius * offset, -to_light};
}

}  // namespace

std::optional<LightSample> InfiniteLight::sample_Li(const LightReceiver& x, const Point2& u) const {
  const Vector3 wi = sample_even_light(x, u);
  return LightSample{wi, L, even_light_pdf(x, wi), Point3(0), true};
}

float InfiniteLight::pdf_Li(const LightReceiver& x, const Vector3& wi) const {
  return even_light_pdf(x, wi);
}

std::optional<EmissionSample> InfiniteLight::sample_Le(const Point2& u_pos, const Point2& u_dir,
                                                       EmissionMode /*mode*/) const {
  if (!(scene_radius > 0)) return std::nullopt;
  return EmissionSample{ray_into_scene(scene_center, scene_radius, sample_uniform_sphere(u_dir), u_pos),
                        power()};
}

std::optional<LightSample> ImageInfiniteLight::sample_Li(const LightReceiver& x, const Point2& u) const {
  const float even = map->even_share();
  const Vector3 wi =
      u.x < even
          ? sample_even_light(x, {std::min(u.x / even, kOneMinusEpsilon), u.y})
          : to_world * map->sample_excess({std::min((u.x - even) / (1 - even), kOneMinusEpsilon), u.y});
  return LightSample{wi, Le({x.p, wi}), pdf_Li(x, wi), Point3(0), true};
}

float ImageInfiniteLight::pdf_Li(const LightReceiver& x, const Vector3& wi) const {
  const float even = map->even_share();
  return even * even_light_pdf(x, wi) + (even < 1 ? (1 - even) * map->excess_pdf(to_map(wi)) : 0);
}

std::optional<EmissionSample> ImageInfiniteLight::sample_Le(const Point2& u_pos, const Point2& u_dir,
                                                            EmissionMode /*mode*/) const {
  const DirectionMap::Sample s = map->sample(u_dir);
  if (!(scene_radius > 0) || is_black(s.value)) return std::nullopt;
  // Flux = L / pdf of the direction, times the area of the disk.
  const float per_radiance = kPi * scene_radius * scene_radius * (scale / s.pdf);
  return EmissionSample{ray_into_scene(scene_center, scene_radius, to_world * s.w, u_pos),
                        per_radiance * s.value};
}

}  // namespace kaustik
