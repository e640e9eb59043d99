// Light samples, predicted visibility, and the MIS weights of emission that rays meet.

#include "render/estimators/lighting.h"

#include "accel/media_walk.h"
#include "core/sampling/mis.h"

namespace kaustik::render {

namespace {

// Ray towards the light sample, ending just before the light: p_light is already offset, and t is in units of
// |d|.
template <class Point>
Ray shadow_ray(const Point& x, const LightSample& s) {
  if (s.infinite) return spawn(x, s.wi);
  Ray ray = spawn(x, s.wi, 1);
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
photon::VisibilityPrediction predicted(const RenderContext& /*ctx*/, const MediumPoint& /*x*/,
                                       LobePart /*part*/, uint32_t /*light*/) {
  return {};
}

template <class Point>
float trace_visibility(const RenderContext& ctx, const Point& x, const LightSample& s,
                       TileCounters& counters) {
  ++counters.rays.shadow;
  return ctx.bvh.occluded(shadow_ray(x, s)) ? 0 : 1;
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
  return samples_each(scene) ? 1 : float(kLightChoices) * scene.light_sampler.probability(x, light);
}

// A light sample and the radiance it contributes if visible: f Li / pdf times its MIS weight.
struct WeightedLightSample {
  LightSample at;
  Rgb contribution{0};
};
// Density of the samples of an infinite light: its own, mixed half and half with the guide where there is
// one.
float guided_pdf(float of_light, const SkyGuide::Directions& guide, const Vector3& wi) {
  return guide.empty() ? of_light : 0.5f * (of_light + guide.pdf(wi));
}

SkyGuide::Directions sky_guide(const RenderContext& ctx, const LightReceiver& x) {
  return ctx.sky ? ctx.sky->at(x.p, x.n) : SkyGuide::Directions{};
}

// Samples an infinite light by guided_pdf().
std::optional<LightSample> sample_guided(const Light& light, const LightReceiver& x,
                                         const SkyGuide::Directions& guide, Point2 u) {
  const bool guided = u.x < 0.5f;
  u.x = std::min(guided ? 2 * u.x : 2 * u.x - 1, kOneMinusEpsilon);
  std::optional<LightSample> s;
  if (guided) {
    const Vector3 wi = guide.sample(u).wi;
    s = LightSample{wi, escaped_radiance(light, {x.p, wi}), escaped_pdf(light, x, wi), {}, true};
  } else {
    s = sample_Li(light, x, u);
  }
  if (s) s->pdf = guided_pdf(s->pdf, guide, s->wi);
  return s;
}

// What the media between x and the light sample let pass.
template <class Point>
Rgb left_of_light(const accel::Bvh& bvh, const Point& x, const LightSample& s) {
  MediumIndex medium = medium_towards(bvh.scene(), x, s.wi);
  const float distance = s.infinite ? kInfinity : glm::distance(position(x), s.p_light);
  return accel::transmittance(bvh.scene(), bvh.interfaces(), spawn(x, s.wi), distance, &medium);
}

bool disperses(const ShadingPoint& x) {
  return scatters_one_wavelength(*x.bsdf);
}
bool disperses(const MediumPoint& /*x*/) {
  return false;
}

// Samples one light; nothing if it contributes nothing. expected: the expected number of samples of this
// light.
template <class Point>
std::optional<WeightedLightSample> sample_light(const RenderContext& ctx, uint32_t light, float expected,
                                                const Point& x, LightWeight weight, LobePart part,
                                                const LightShares& shares, const Point2& u) {
  const Light& from = ctx.scene.lights[light];
  const LightReceiver receiver = x.receiver();
  const SkyGuide::Directions guide = is_infinite(from) ? sky_guide(ctx, receiver) : SkyGuide::Directions{};
  const auto s = guide.empty() ? sample_Li(from, receiver, u) : sample_guided(from, receiver, guide, u);
  if (!s || !(s->pdf > 0)) return std::nullopt;
  const Rgb f = f_cos(x, s->wi, part);
  if (is_black(f) || is_black(s->Li)) return std::nullopt;
  const float pdf = s->pdf * expected;
  const bool shared = weight == LightWeight::kMis && !is_delta(from);
  const float w = shared ? power_heuristic(pdf, scatter_pdf(x, s->wi, part)) : 1;
  const bool glossy_source = part == LobePart::kGlossy && is_delta(from) && !disperses(x);
  const float share = glossy_source ? shares.of_glossy(f * s->Li) : shares.of(light, {position(x), s->wi});
  WeightedLightSample weighted{*s, f * s->Li * (w / pdf * share)};
  if (ctx.scene.needs.media) weighted.contribution *= left_of_light(ctx.bvh, x, *s);
  return weighted;
}

// Light samples of which at most one is corrected by a shadow ray (Talbot et al. 2005). The estimate is the
// sum of each sample's contribution times its predicted V. The shadow ray is traced with the largest p of all
// samples, for a sample chosen in proportion to contribution times p.
class CompetingSamples {
 public:
  void add(const WeightedLightSample& sample, const photon::VisibilityPrediction& prediction) {
    const Rgb& c = sample.contribution;
    const float size = (c.x + c.y + c.z) * prediction.p;
    sum_ += c * prediction.v;
    all_ += size;
    p_ = std::max(p_, prediction.p);
    candidates_[count_++] = {sample, prediction.v, size};
  }

  // u_ray in [0, 1) decides about the shadow ray.
  template <class Point>
  Rgb estimate(const RenderContext& ctx, const Point& x, float u_ray, TileCounters& counters) const {
    if (!(u_ray < p_)) return sum_;
    float at = u_ray / p_ * all_;
    for (size_t i = 0; i < count_; ++i) {
      const Candidate& c = candidates_[i];
      if (at < c.size)
        return sum_ + c.sample.contribution *
                          ((trace_visibility(ctx, x, c.sample.at, counters) - c.v) * (all_ / (c.size * p_)));
      at -= c.size;
    }
    return sum_;
  }

 private:
  struct Candidate {
    WeightedLightSample sample;
    float v, size;
  };
  std::array<Candidate, kLightChoices> candidates_;
  size_t count_ = 0;
  float all_ = 0, p_ = 0;
  Rgb sum_{0};
};

// Number k of a sequence that starts at u and covers the unit square evenly (Roberts 2018, R2), so that
// samples of one light that compete do not coincide.
Point2 shifted(const Point2& u, uint32_t k) {
  const auto wrapped = [](float v) { return std::min(v - std::floor(v), kOneMinusEpsilon); };
  return {wrapped(u.x + 0.7548776662f * float(k)), wrapped(u.y + 0.5698402910f * float(k))};
}

// Samples a light by itself: the predicted V, corrected by a shadow ray with probability p. Where V is
// predicted for sure, a hidden light needs no sample and a visible one no ray.
template <class Point>
Rgb sample_one_light(const RenderContext& ctx, uint32_t light, const Point& x, LightWeight weight,
                     float u_ray, const Point2& u, TileCounters& counters, LobePart part,
                     const LightShares& shares) {
  const photon::VisibilityPrediction prediction = predicted(ctx, x, part, light);
  const bool traced = u_ray < prediction.p;
  if (!traced && prediction.v == 0) return Rgb(0);
  const auto s = sample_light(ctx, light, 1, x, weight, part, shares, u);
  if (!s) return Rgb(0);
  return s->contribution *
         (traced ? prediction.v + (trace_visibility(ctx, x, s->at, counters) - prediction.v) / prediction.p
                 : prediction.v);
}

// Draws kLightChoices lights, stratified by u_light.
template <class Point>
Rgb sample_chosen_lights(const RenderContext& ctx, const Point& x, LightWeight weight, float u_light,
                         float u_ray, const Point2& u, TileCounters& counters, LobePart part,
                         const LightShares& shares) {
  CompetingSamples samples;
  for (uint32_t k = 0; k < kLightChoices; ++k) {
    const float stratum = std::min((float(k) + u_light) / kLightChoices, kOneMinusEpsilon);
    const auto choice = ctx.scene.light_sampler.choose(x.receiver(), stratum);
    if (!choice) continue;
    const float expected = kLightChoices * choice->probability;
    if (const auto s = sample_light(ctx, choice->light, expected, x, weight, part, shares, shifted(u, k)))
      samples.add(*s, predicted(ctx, x, part, choice->light));
  }
  return samples.estimate(ctx, x, u_ray, counters);
}

// Returns f Li / pdf of one sample of the light, as if nothing were in the way.
Rgb unoccluded_from(const RenderContext& ctx, uint32_t light, const ShadingPoint& x, const Point2& u) {
  const auto s = sample_light(ctx, light, 1, x, LightWeight::kAlone, LobePart::kDiffuse, {}, u);
  return s ? s->contribution : Rgb(0);
}

template <class Point>
Rgb sample_direct_at(const RenderContext& ctx, const Point& x, LightWeight weight, Sampler& sampler,
                     TileCounters& counters, LobePart part, const LightShares& shares) {
  const float u_light = sampler.next_1d();
  const Point2 u = sampler.next_2d();
  const Scene& scene = ctx.scene;
  if (dark(scene)) return Rgb(0);
  if (samples_each(scene)) {
    Rgb sum(0);
    for (uint32_t light = 0; light < scene.lights.size(); ++light)
      sum += sample_one_light(ctx, light, x, weight, u_light, u, counters, part, shares);
    return sum;
  }
  const float u_ray = sampler.next_1d();
  return sample_chosen_lights(ctx, x, weight, u_light, u_ray, u, counters, part, shares);
}

}  // namespace

Rgb sample_direct(const RenderContext& ctx, const ShadingPoint& x, LightWeight weight, Sampler& sampler,
                  TileCounters& counters, LobePart part, const LightShares& shares) {
  return sample_direct_at(ctx, x, weight, sampler, counters, part, shares);
}

Rgb sample_direct(const RenderContext& ctx, const MediumPoint& x, LightWeight weight, Sampler& sampler,
                  TileCounters& counters) {
  return sample_direct_at(ctx, x, weight, sampler, counters, LobePart::kDiffuse, {});
}

bool direct_needs_bsdf_sample(const Scene& scene, const ShadingPoint& x) {
  return lobes(*x.bsdf).rough || scene.light_sampler.any_near(x.receiver());
}

Rgb unoccluded_direct(const RenderContext& ctx, const ShadingPoint& x, Sampler& sampler) {
  const float u_light = sampler.next_1d();
  const Point2 u = sampler.next_2d();
  const Scene& scene = ctx.scene;
  if (dark(scene)) return Rgb(0);
  if (scene.lights.size() > kMostLightsSummed) {
    const auto light = scene.light_sampler.choose(x.receiver(), u_light);
    return light ? unoccluded_from(ctx, light->light, x, u) / light->probability : Rgb(0);
  }
  Rgb sum(0);
  for (uint32_t light = 0; light < scene.lights.size(); ++light) sum += unoccluded_from(ctx, light, x, u);
  return sum;
}

Rgb emitted(const Scene& scene, const SurfaceInteraction& si, const Vector3& w) {
  if (si.light == kNoIndex) return Rgb(0);
  const auto* area = std::get_if<DiffuseAreaLight>(&scene.lights[si.light]);
  return area ? area->Le(si, w) : Rgb(0);
}

Rgb escaped(const Scene& scene, const Ray& ray, const LightShares& shares) {
  Rgb sum(0);
  for (const uint32_t i : scene.infinite_lights)
    sum += escaped_radiance(scene.lights[i], ray) * shares.of(i, ray);
  return sum;
}

float emitter_hit_weight(const Scene& scene, const LightReceiver& x, const Vector3& wi, float bsdf_pdf,
                         const SurfaceInteraction& si) {
  const auto* area = std::get_if<DiffuseAreaLight>(&scene.lights[si.light]);
  if (!area) return 0;
  return power_heuristic(bsdf_pdf, samples_of(scene, x, si.light) * area->pdf_Li(x.p, wi, si));
}

Rgb escaped_weighted(const RenderContext& ctx, const LightReceiver& x, const Ray& ray, float bsdf_pdf,
                     const LightShares& shares) {
  Rgb sum(0);
  const SkyGuide::Directions guide = sky_guide(ctx, x);
  for (const uint32_t i : ctx.scene.infinite_lights) {
    const Light& light = ctx.scene.lights[i];
    const float light_pdf =
        samples_of(ctx.scene, x, i) * guided_pdf(escaped_pdf(light, x, ray.d), guide, ray.d);
    sum += escaped_radiance(light, ray) * (power_heuristic(bsdf_pdf, light_pdf) * shares.of(i, ray));
  }
  return sum;
}

}  // namespace kaustik::render
