#include "render/photon_maps.h"

#include <atomic>
#include <chrono>

#include "render/radius.h"

namespace kaustik::render {

namespace {

using photon::PhotonKind;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

photon::TraceSettings trace_settings(const RenderSettings& settings, const EstimatorPlan& plan) {
  photon::TraceSettings trace;
  trace.seed = settings.seed;
  trace.photons = settings.photons;
  trace.max_bounces = settings.max_bounces;
  trace.emission = settings.emission;
  trace.kinds = kinds_needed(plan);
  return trace;
}

photon::EstimateSettings estimate_settings(const RenderSettings& settings) {
  photon::EstimateSettings estimate;
  estimate.kernel.type = photon::KernelType(int(settings.kernel));
  estimate.kernel.cone_k = settings.cone_k;
  estimate.nearest = settings.nearest;
  estimate.leaf = settings.lookup == Lookup::kLeaf;
  estimate.node_photons = settings.node_photons;
  return estimate;
}
static_assert(int(Kernel::kCone) == int(photon::KernelType::kCone) &&
              int(Kernel::kEpanechnikov) == int(photon::KernelType::kEpanechnikov));

// One cube for all maps: the lecture's test reads direct and shadow photons of the same cell.
void build_maps(const Scene& scene, const RenderSettings& settings, photon::ShootResult&& shot,
                PhotonMaps* maps) {
  const photon::MapSettings in_scene{scene.bounds};
  const auto build = [&](PhotonKind kind) {
    return photon::PhotonMap::build(std::move(shot.buffers[size_t(kind)]), in_scene);
  };
  maps->direct = {build(PhotonKind::kDirect), estimate_settings(settings)};
  maps->caustic = {build(PhotonKind::kCaustic), estimate_settings(settings)};
  maps->indirect = {build(PhotonKind::kIndirect), estimate_settings(settings)};
  maps->shadow = build(PhotonKind::kShadow);
}

void settle_radii(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                  const EstimatorPlan& plan, PhotonMaps* maps, RenderStatistics* s) {
  const photon::KindMask kinds = kinds_needed(plan);
  if (!kinds.any()) return;
  const GatherRadii radii = choose_radii(scene, bvh, settings, *maps);
  if (kinds.direct) maps->direct.estimate.radius = s->direct_radius = radii.direct;
  if (!settings.radius && settings.nearest == 0) maps->caustic.estimate.nearest = kCausticNearest;
  if (kinds.caustic) maps->caustic.estimate.radius = s->caustic_radius = radii.caustic;
  if (kinds.indirect) maps->indirect.estimate.radius = s->indirect_radius = radii.indirect;
  s->radius = std::max({s->direct_radius, s->caustic_radius, s->indirect_radius});
  maps->lecture = {radii.direct, settings.node_photons, settings.min_photons};
}

// Of the scene alone: every pass would find the same.
void find_edges(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings, PhotonMaps* maps) {
  if (settings.lookup == Lookup::kLeaf) return;
  maps->edges =
      std::make_unique<accel::EdgeIndex>(accel::without_continued(find_boundary_edges(scene.shapes), bvh));
  for (ReadMap* read : {&maps->direct, &maps->caustic, &maps->indirect})
    read->estimate.edges = maps->edges.get();
}

}  // namespace

photon::KindMask kinds_needed(const EstimatorPlan& plan) {
  photon::KindMask kinds;
  kinds.direct = plan.direct != DirectEstimator::kShadowRays;
  kinds.shadow = plan.direct == DirectEstimator::kLecture;
  kinds.caustic = plan.caustics == CausticEstimator::kPhotons;
  kinds.indirect = plan.indirect == IndirectEstimator::kPhotons;
  return kinds;
}

bool make_photon_maps(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                      const EstimatorPlan& plan, const ProgressCallback& progress, PhotonMaps* maps,
                      RenderStatistics* statistics) {
  if (!kinds_needed(plan).any()) return true;
  const auto start = std::chrono::steady_clock::now();
  std::atomic<bool> cancelled{false};
  auto shot = photon::shoot(scene, bvh, trace_settings(settings, plan), [&](uint64_t done, uint64_t total) {
    const bool go_on = !progress || progress({"photons", done, total});
    if (!go_on) cancelled = true;
    return go_on;
  });
  statistics->photons = shot.counters;
  statistics->photon_trace_s = seconds_since(start);
  if (cancelled) return false;

  const auto build_start = std::chrono::steady_clock::now();
  build_maps(scene, settings, std::move(shot), maps);
  settle_radii(scene, bvh, settings, plan, maps, statistics);
  find_edges(scene, bvh, settings, maps);
  for (const photon::PhotonMap* map :
       {&maps->direct.map, &maps->caustic.map, &maps->indirect.map, &maps->shadow})
    statistics->photon_bytes += map->memory_bytes();
  statistics->photon_build_s = seconds_since(build_start);
  return !progress || progress({"build", 1, 1});
}

}  // namespace kaustik::render
