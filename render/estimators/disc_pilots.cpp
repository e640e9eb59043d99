#include "render/estimators/disc_pilots.h"

#include <algorithm>
#include <optional>

#include "core/parallel/parallel.h"

namespace kaustik::render {

namespace {

// Separates the random numbers of these paths from all others.
constexpr uint64_t kPilotPaths = 0xD15C;
constexpr int kPathsEach = 4;
constexpr uint64_t kSamplesEach = 8;  // of the pass, for each path
constexpr uint64_t kMostPoints = 1u << 16;
constexpr uint64_t kFewestPoints = 1024;

// Empty on rough lobes, where the picture takes a disc only if a wide glossy lobe sees the point, and for
// estimates that are not finite, which the picture would drop.
std::optional<TwoEstimates> estimate_at(const RenderContext& ctx, const VisiblePoint& point,
                                        Sampler& sampler) {
  ShadingPoint x(ctx.scene, point.si, point.wo);
  x.medium = point.medium;
  if (lobes(*x.bsdf).rough) return {};
  TileCounters ignored;
  TwoEstimates found;
  const GatherMap& indirect = ctx.maps.indirect;
  found.disc = glm::dvec3(
      photon::estimate_radiance(indirect.map, x.si, x.wo, *x.bsdf, indirect.estimate, ignored.gather));
  const PathReach reach = final_gather_reach(ctx);
  for (int i = 0; i < kPathsEach; ++i)
    found.path += glm::dvec3(trace_path(ctx, x, reach, sampler, ignored).indirect) / double(kPathsEach);
  if (!is_finite(Rgb(found.disc)) || !is_finite(Rgb(found.path))) return {};
  return found;
}

// Compares at up to `count` points. The gathers at the far ends of paths are corrected by ctx.discs.
std::unique_ptr<const DiscCorrection> compare_at(const RenderContext& ctx, uint32_t count) {
  std::vector<VisiblePoint> points = visible_points(ctx, count);
  std::vector<std::optional<TwoEstimates>> found(points.size());
  const uint64_t stream = hash_combine(hash_combine(ctx.settings.seed, kPilotPaths), ctx.pass.pass);
  parallel::for_index(size_t{0}, points.size(), [&](size_t i) {
    Sampler sampler(hash_combine(stream, count), i);
    found[i] = estimate_at(ctx, points[i], sampler);
  });
  std::vector<TwoEstimates> kept;
  for (size_t i = 0; i < points.size(); ++i)
    if (found[i]) points[kept.size()] = points[i], kept.push_back(*found[i]);
  points.resize(kept.size());
  return std::make_unique<const DiscCorrection>(points, kept);
}

}  // namespace

uint64_t disc_pilot_points(const RenderContext& ctx, uint64_t samples) {
  if (ctx.plan.indirect != IndirectEstimator::kFinalGather || !ctx.maps.surroundings) return 0;
  const Camera& camera = ctx.scene.camera;
  const uint64_t pixels = uint64_t(camera.width) * uint64_t(camera.height);
  const uint64_t paths = pixels * samples / kSamplesEach;
  return std::clamp(paths / kPathsEach, kFewestPoints, kMostPoints);
}

std::unique_ptr<const DiscCorrection> measure_discs(const RenderContext& ctx, uint64_t points) {
  if (points == 0) return nullptr;
  // A first round corrects the gathers at the far ends of the paths of the second.
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
