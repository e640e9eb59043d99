#include "render/lighting.h"

namespace kaustik::render {

namespace {

// Veach 1997, section 9.2.4, beta = 2. As a ratio, so that squares of large densities do not overflow.
float power_heuristic(float pdf, float other) {
  if (!(pdf > 0)) return 0;
  const float ratio = other / pdf;
  return 1 / (1 + ratio * ratio);
}

// The shadow ray ends just off the lamp: p_light is already offset, t counts in lengths of d.
Ray shadow_ray(const SurfaceInteraction& si, const LightSample& s) {
  if (s.infinite) return si.spawn(s.wi);
  Ray ray = si.spawn(s.wi, 1);
  ray.d = s.p_light - ray.o;
  return ray;
}

}  // namespace

Rgb sample_direct(const RenderContext& ctx, const ShadingPoint& x, LightWeight weight, Sampler& sampler,
                  TileCounters& counters) {
  const float u_lamp = sampler.next_1d();
  const Point2 u = sampler.next_2d();
  const Scene& scene = ctx.scene;
  if (scene.light_power.empty() || !(scene.light_power.total() > 0)) return Rgb(0);
  const auto lamp = scene.light_power.sample(u_lamp);
  const Light& light = scene.lights[lamp.index];
  const auto s = std::visit([&](const auto& l) { return l.sample_Li(x.si.p, u); }, light);
  if (!s || !(s->pdf > 0)) return Rgb(0);
  const Rgb f = f_cos(x, s->wi);
  if (is_black(f) || is_black(s->Li)) return Rgb(0);
  ++counters.rays.shadow;
  if (ctx.bvh.occluded(shadow_ray(x.si, *s))) return Rgb(0);
  const float pdf = s->pdf * lamp.pdf;
  const bool shared = weight == LightWeight::kMis && !is_delta(light);
  const float w = shared ? power_heuristic(pdf, scatter_pdf(x, s->wi)) : 1;
  return f * s->Li * (w / pdf);
}

Rgb emitted(const Scene& scene, const SurfaceInteraction& si, const Vector3& w) {
  if (si.light == kNoIndex) return Rgb(0);
  const auto* area = std::get_if<DiffuseAreaLight>(&scene.lights[si.light]);
  return area ? area->Le(si.n, w) : Rgb(0);
}

Rgb escaped(const Scene& scene) {
  Rgb sum(0);
  for (const uint32_t i : scene.infinite_lights) sum += std::get<InfiniteLight>(scene.lights[i]).Le();
  return sum;
}

float emitter_hit_weight(const Scene& scene, const Point3& ref, const Vector3& wi, float bsdf_pdf,
                         const SurfaceInteraction& si) {
  const auto* area = std::get_if<DiffuseAreaLight>(&scene.lights[si.light]);
  if (!area) return 0;
  return power_heuristic(bsdf_pdf, scene.light_power.pdf(si.light) * area->pdf_Li(ref, wi, si));
}

Rgb escaped_weighted(const Scene& scene, float bsdf_pdf) {
  Rgb sum(0);
  for (const uint32_t i : scene.infinite_lights) {
    const auto& light = std::get<InfiniteLight>(scene.lights[i]);
    sum += light.Le() * power_heuristic(bsdf_pdf, scene.light_power.pdf(i) * light.pdf_Li());
  }
  return sum;
}

}  // namespace kaustik::render
