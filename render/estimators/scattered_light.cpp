#include "render/estimators/scattered_light.h"

#include <optional>

#include "photon/estimate/beam_estimate.h"
#include "render/estimators/beam_sampler.h"

namespace kaustik::render {

namespace {

// How far paths that start in media are followed.
PathReach reach_of(const RenderContext& ctx, const MediumPoint& m) {
  const EstimatorPlan& plan = ctx.plan;
  const bool paths = !plan.medium_indirect && plan.indirect != IndirectEstimator::kOff;
  if (paths) return PathReach::kRoulette;
  if (plan.caustics == CausticEstimator::kPaths) return PathReach::kSpecular;
  return ctx.scene.light_sampler.any_near(m.receiver()) ? PathReach::kLights : PathReach::kNone;
}

// Media that scatter less of the ray's light than this are sampled less often.
constexpr float kDim = 0.02f;

// One sample of what arrives at a point of the ray, over its density.
PathLight sampled(const RenderContext& ctx, const Beam& beam, const Rgb& beta, PathReach of_media,
                  Sampler& sampler, TileCounters& counters) {
  const Medium& medium = ctx.scene.media[beam.medium];
  const BeamSampler points(ctx.scene, medium, beam.ray, beam.distance, beta);
  const Point2 u = sampler.next_2d();
  const float q = std::min(points.opacity() * max_component(beta) / kDim, 1.0f);
  if (!(sampler.next_1d() < q)) return {};
  const BeamSampler::Sample at = points.sample(u);
  if (is_black(at.weight)) return {};
  const MediumPoint m{beam.ray.at(at.t), -beam.ray.d, medium.g, beam.medium, beam.wavelength};
  const PathReach reach = reach_of(ctx, m);
  const LightWeight weight = reach == PathReach::kNone ? LightWeight::kAlone : LightWeight::kMis;
  PathLight light;
  light.direct = sample_direct(ctx, m, weight, sampler, counters);
  light += trace_paths(ctx, m, reach, of_media, sampler, counters);
  const Rgb factor = at.weight / q;
  return {factor * light.direct, factor * light.caustic, factor * light.indirect};
}

Rgb gathered(const RenderContext& ctx, const Beam& beam, const ColumnTable* columns, const GatherMap& gather,
             TileCounters& counters) {
  const photon::BeamQuery query{beam.ray, beam.distance, gather.estimate.radius, beam.medium, columns};
  return photon::estimate_beam(gather.map, query, ctx.scene.media[beam.medium], gather.estimate.kernel,
                               gather.estimate.nearest, counters.gather, &ctx.bvh);
}

}  // namespace

PathLight scattered_light(const RenderContext& ctx, const Beam& beam, const Rgb& beta, SampleLight light,
                          PathReach of_media, Sampler& sampler, TileCounters& counters) {
  if (!ctx.scene.media[beam.medium].scatters()) return {};
  PathLight sum = sampled(ctx, beam, beta, of_media, sampler, counters);
  const bool caustics = ctx.plan.medium_caustics, indirect = ctx.plan.medium_indirect;
  if (light == SampleLight::kTraced || !(caustics || indirect)) return sum;
  std::optional<ColumnTable> table;
  if (const auto& density = ctx.scene.media[beam.medium].density)
    table.emplace(*density, beam.ray, beam.distance);
  const ColumnTable* const columns = table ? &*table : nullptr;
  if (caustics) sum.caustic += gathered(ctx, beam, columns, ctx.maps.medium_caustic, counters);
  if (indirect) sum.indirect += gathered(ctx, beam, columns, ctx.maps.medium_indirect, counters);
  return sum;
}

}  // namespace kaustik::render
