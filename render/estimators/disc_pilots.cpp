#include "render/estimators/disc_pilots.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace kaustik::render {

namespace {

// Separates the random numbers of these paths from all others.
constexpr uint64_t kPilotPaths = 0xD15C;
constexpr int kPathsEach = 4;
constexpr uint64_t kSamplesEach = 4;  // of the pass, for each path
constexpr uint64_t kMostPoints = 1u << 16;
constexpr uint64_t kFewestPoints = 64;

TwoEstimates estimate_at(const RenderContext& ctx, const VisiblePoint& point, Sampler& sampler) {
  const ShadingPoint x(ctx.scene, point.si, point.wo);
  if (lobes(*x.bsdf).rough) return {};  // always takes a path
  TileCounters ignored;
  TwoEstimates found;
  const GatherMap& indirect = ctx.maps.indirect;
  found.disc = glm::dvec3(
      photon::estimate_radiance(indirect.map, x.si, x.wo, *x.bsdf, indirect.estimate, ignored.gather));
  const PathReach reach = final_gather_reach(ctx);
  for (int i = 0; i < kPathsEach; ++i)
    found.path += glm::dvec3(trace_path(ctx, x, reach, sampler, ignored).indirect) / double(kPathsEach);
  return found;
}

// Compares at `count` points; the far ends of paths read the map as ctx.discs corrects it.
std::unique_ptr<const DiscCorrection> compare_at(const RenderContext& ctx, uint32_t count) {
  const std::vector<VisiblePoint> points = visible_points(ctx, count);
  std::vector<TwoEstimates> found(points.size());
  const uint64_t stream = hash_combine(hash_combine(ctx.settings.seed, kPilotPaths), ctx.pass.pass);
  tbb::parallel_for(size_t{0}, points.size(), [&](size_t i) {
    Sampler sampler(hash_combine(stream, count), i);
    found[i] = estimate_at(ctx, points[i], sampler);
  });
  return std::make_unique<const DiscCorrection>(points, found);
}

}  // namespace

std::unique_ptr<const DiscCorrection> measure_discs(const RenderContext& ctx) {
  if (ctx.plan.indirect != IndirectEstimator::kFinalGather || !ctx.maps.surroundings) return nullptr;
  const Camera& camera = ctx.scene.camera;
  const uint64_t pixels = uint64_t(camera.width) * uint64_t(camera.height);
  const uint64_t paths = pixels * (ctx.samples.end - ctx.samples.first) / kSamplesEach;
  const uint64_t points = std::clamp(paths / kPathsEach, kFewestPoints, kMostPoints);
  // A first round corrects what the paths of the second read at their far ends.
  RenderContext corrected = ctx;
  const auto first = compare_at(ctx, uint32_t(points / 4));
  corrected.discs = first.get();
  return compare_at(corrected, uint32_t(points - points / 4));
}

PathReach final_gather_reach(const RenderContext& ctx) {
  constexpr int kDeepEnough = 8;
  const bool reads_caustics = ctx.plan.caustics == CausticEstimator::kPhotons || !ctx.scene.needs.specular;
  return ctx.settings.max_bounces < kDeepEnough || !reads_caustics ? PathReach::kRoulette : PathReach::kMaps;
}

}  // namespace kaustik::render
