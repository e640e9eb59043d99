#include "render/estimators/emission_of_media.h"

#include "accel/media_walk.h"
#include "core/sampling/mis.h"

namespace kaustik::render {

namespace {

template <class Point>
Rgb sample_at(const RenderContext& ctx, const Point& x, Sampler& sampler, TileCounters& counters) {
  const Scene& scene = ctx.scene;
  if (scene.emissive_bodies.empty()) return Rgb(0);
  const float u_body = sampler.next_1d();
  const EmissiveBodies::Sample s = scene.emissive_bodies.sample(position(x), u_body, sampler.next_2d());
  if (!(s.pdf > 0)) return Rgb(0);
  const Rgb f = f_cos(x, s.wi);
  if (is_black(f)) return Rgb(0);
  ++counters.rays.shadow;
  const Ray ray = spawn(x, s.wi);
  const Hit hit = ctx.bvh.intersect(ray);
  const Rgb Le = accel::emitted_radiance(scene, ctx.bvh.interfaces(), ray, hit.valid() ? hit.t : kInfinity,
                                         medium_towards(scene, x, s.wi));
  return f * Le * (power_heuristic(s.pdf, scatter_pdf(x, s.wi)) / s.pdf);
}

}  // namespace

Rgb sample_emission_of_media(const RenderContext& ctx, const ShadingPoint& x, Sampler& sampler,
                             TileCounters& counters) {
  return sample_at(ctx, x, sampler, counters);
}

Rgb sample_emission_of_media(const RenderContext& ctx, const MediumPoint& x, Sampler& sampler,
                             TileCounters& counters) {
  return sample_at(ctx, x, sampler, counters);
}

float emission_of_media_weight(const Scene& scene, const Point3& x, const Vector3& wi, float bsdf_pdf) {
  return power_heuristic(bsdf_pdf, scene.emissive_bodies.pdf(x, wi));
}

}  // namespace kaustik::render
