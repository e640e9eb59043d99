// Light samples, predicted visibility, and the MIS weights of emission that rays meet.

#include "render/estimators/lighting.h"

namespace kaustik::render {

namespace {

// Power heuristic with beta = 2 (Veach 1997, section 9.2.4). Computed from a ratio, so that squares of large
// densities do not overflow.
float power_heuristic(float pdf, float other) {
  if (!(pdf > 0)) return 0;
  const float ratio = other / pdf;
  return 1 / (1 + ratio * ratio);
}

// Ray towards the light sample, ending just before the light: p_light is already offset, and t is in units of
// |d|.
Ray shadow_ray(const SurfaceInteraction& si, const LightSample& s) {
  if (s.infinite) return si.spawn(s.wi);
  Ray ray = si.spawn(s.wi, 1);
  ray.d = s.p_light - ray.o;
  return ray;
}

// Predicted visibility of the light on the viewer's side of x. Nothing is predicted for BSDFs that transmit,
// since that light arrives on the other side, nor for glossy lobes, where a wrong prediction would give too
// bright a sample.
photon::VisibilityPrediction predicted(const RenderContext& ctx, const ShadingPoint& x, LobePart part,
                                       uint32_t light) {
  if (!ctx.visibility || part == LobePart::kGlossy || transmits(*x.bsdf)) return {};
  return ctx.visibility->predict(light, x.si.p, glm::dot(x.wo, x.si.n) < 0 ? -x.si.n : x.si.n);
}

float trace_visibility(const RenderContext& ctx, const ShadingPoint& x, const LightSample& s,
                       TileCounters& counters) {
  ++counters.rays.shadow;
  return ctx.bvh.occluded(shadow_ray(x.si, s)) ? 0 : 1;
}

bool dark(const Scene& scene) {
  return scene.light_power.empty() || !(scene.light_power.total() > 0);
}

// Up to this many lights are sampled once each; of more lights one is chosen.
constexpr size_t kMostLightsSampled = LightSampler::kMostByPower;
bool samples_each(const Scene& scene) {
  return scene.lights.size() <= kMostLightsSampled;
}
// Expected number of samples that sample_direct() takes of the light.
float samples_of(const Scene& scene, const LightReceiver& x, uint32_t light) {
  return samples_each(scene) ? 1 : scene.light_sampler.probability(x, light);
}

// A light sample and the radiance it contributes if visible: f Li / pdf times its MIS weight.
struct WeightedLightSample {
  LightSample at;
  Rgb contribution{0};
};
// Samples one light; nothing if it contributes nothing. expected: the expected number of samples of this
// light.
std::optional<WeightedLightSample> sample_light(const Scene& scene, uint32_t light, float expected,
                                                const ShadingPoint& x, LightWeight weight, LobePart part,
                                                const Point2& u) {
  const auto s = sample_Li(scene.lights[light], x.receiver(), u);
  if (!s || !(s->pdf > 0)) return std::nullopt;
  const Rgb f = f_cos(x, s->wi, part);
  if (is_black(f) || is_black(s->Li)) return std::nullopt;
  const float pdf = s->pdf * expected;
  const bool shared = weight == LightWeight::kMis && !is_delta(scene.lights[light]);
  const float w = shared ? power_heuristic(pdf, scatter_pdf(x, s->wi, part)) : 1;
  return WeightedLightSample{*s, f * s->Li * (w / pdf)};
}

// Sum over all lights of each sample's contribution times its predicted V. At most one light is corrected by
// a shadow ray, which is traced with the largest p of all of them; the light is chosen in proportion to
// contribution times p.
Rgb sample_each_light(const RenderContext& ctx, const ShadingPoint& x, LightWeight weight, float u_ray,
                      const Point2& u, TileCounters& counters, LobePart part) {
  struct Candidate {
    WeightedLightSample sample;
    float v, size;
  };
  std::array<Candidate, kMostLightsSampled> candidates;
  size_t count = 0;
  float all = 0, p = 0;
  Rgb sum(0);
  for (uint32_t light = 0; light < ctx.scene.lights.size(); ++light) {
    const auto s = sample_light(ctx.scene, light, 1, x, weight, part, u);
    if (!s) continue;
    const photon::VisibilityPrediction prediction = predicted(ctx, x, part, light);
    const float size = s->contribution.x + s->contribution.y + s->contribution.z;
    sum += s->contribution * prediction.v;
    all += size * prediction.p;
    p = std::max(p, prediction.p);
    candidates[count++] = {*s, prediction.v, size * prediction.p};
  }
  if (!(u_ray < p)) return sum;
  float at = u_ray / p * all;
  for (size_t i = 0; i < count; ++i) {
    const Candidate& c = candidates[i];
    if (at < c.size)
      return sum + c.sample.contribution *
                       ((trace_visibility(ctx, x, c.sample.at, counters) - c.v) * (all / (c.size * p)));
    at -= c.size;
  }
  return sum;
}

// Returns f Li / pdf of one sample of the light, as if nothing were in the way.
Rgb unoccluded_from(const Scene& scene, uint32_t light, const ShadingPoint& x, const Point2& u) {
  const auto s = sample_light(scene, light, 1, x, LightWeight::kAlone, LobePart::kDiffuse, u);
  return s ? s->contribution : Rgb(0);
}

}  // namespace

Rgb sample_direct(const RenderContext& ctx, const ShadingPoint& x, LightWeight weight, Sampler& sampler,
                  TileCounters& counters, LobePart part) {
  const float u_light = sampler.next_1d();
  const Point2 u = sampler.next_2d();
  const Scene& scene = ctx.scene;
  if (dark(scene)) return Rgb(0);
  if (scene.lights.size() > 1 && samples_each(scene))
    return sample_each_light(ctx, x, weight, u_light, u, counters, part);
  const auto light = scene.light_sampler.choose(x.receiver(), u_light);
  if (!light) return Rgb(0);
  // u_remapped, left over from choosing the light, is again uniform and independent of the light and the
  // point on it.
  const photon::VisibilityPrediction prediction = predicted(ctx, x, part, light->light);
  const bool traced = light->u_remapped < prediction.p;
  if (!traced && prediction.v == 0) return Rgb(0);
  const auto s = sample_light(scene, light->light, light->probability, x, weight, part, u);
  if (!s) return Rgb(0);
  return s->contribution *
         (traced ? prediction.v + (trace_visibility(ctx, x, s->at, counters) - prediction.v) / prediction.p
                 : prediction.v);
}

Rgb unoccluded_direct(const RenderContext& ctx, const ShadingPoint& x, Sampler& sampler) {
  const float u_light = sampler.next_1d();
  const Point2 u = sampler.next_2d();
  const Scene& scene = ctx.scene;
  if (dark(scene)) return Rgb(0);
  if (scene.lights.size() > kMostLightsSummed) {
    const auto light = scene.light_sampler.choose(x.receiver(), u_light);
    return light ? unoccluded_from(scene, light->light, x, u) / light->probability : Rgb(0);
  }
  Rgb sum(0);
  for (uint32_t light = 0; light < scene.lights.size(); ++light) sum += unoccluded_from(scene, light, x, u);
  return sum;
}

Rgb emitted(const Scene& scene, const SurfaceInteraction& si, const Vector3& w) {
  if (si.light == kNoIndex) return Rgb(0);
  const auto* area = std::get_if<DiffuseAreaLight>(&scene.lights[si.light]);
  return area ? area->Le(si, w) : Rgb(0);
}

Rgb escaped(const Scene& scene, const Ray& ray) {
  Rgb sum(0);
  for (const uint32_t i : scene.infinite_lights) sum += escaped_radiance(scene.lights[i], ray);
  return sum;
}

float emitter_hit_weight(const Scene& scene, const LightReceiver& x, const Vector3& wi, float bsdf_pdf,
                         const SurfaceInteraction& si) {
  const auto* area = std::get_if<DiffuseAreaLight>(&scene.lights[si.light]);
  if (!area) return 0;
  return power_heuristic(bsdf_pdf, samples_of(scene, x, si.light) * area->pdf_Li(x.p, wi, si));
}

Rgb escaped_weighted(const Scene& scene, const LightReceiver& x, const Ray& ray, float bsdf_pdf) {
  Rgb sum(0);
  for (const uint32_t i : scene.infinite_lights) {
    const Light& light = scene.lights[i];
    const float light_pdf = samples_of(scene, x, i) * escaped_pdf(light, x, ray.d);
    sum += escaped_radiance(light, ray) * power_heuristic(bsdf_pdf, light_pdf);
  }
  return sum;
}

}  // namespace kaustik::render
