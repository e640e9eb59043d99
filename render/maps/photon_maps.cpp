// Shoots the photons of a pass, builds the maps, and sets how they are gathered.

#include "render/maps/photon_maps.h"

#include <atomic>
#include <cmath>
#include <numbers>

#include "core/stopwatch.h"
#include "photon/visibility/visibility_shoot.h"
#include "render/maps/radius.h"
#include "render/maps/visible_points.h"

namespace kaustik::render {

namespace {

using photon::PhotonKind;

// A count of photons that is meant for all passes, converted to the photons of one pass: rounded, at least 1.
uint32_t share(uint32_t photons, const PassShare& pass) {
  return static_cast<uint32_t>(std::max<uint64_t>(1, (photons + pass.shares / 2) / pass.shares));
}

photon::EstimateSettings estimate_settings(const RenderSettings& settings, const PassShare& pass) {
  photon::EstimateSettings estimate;
  estimate.kernel = {settings.kernel, settings.cone_k};
  if (settings.nearest > 0) estimate.nearest = photons_in_reach(settings.nearest, pass.shares);
  estimate.leaf = settings.lookup == Lookup::kLeaf;
  estimate.node_photons = share(settings.node_photons, pass);
  return estimate;
}

// Builds all maps in one cube, since the lecture's test compares direct and shadow photons of the same cell.
void build_maps(const Scene& scene, photon::ShootResult&& shot, PhotonMaps* maps) {
  const photon::MapSettings in_scene{scene.bounds};
  const auto build = [&](PhotonKind kind) {
    return photon::PhotonMap::build(std::move(shot.buffers[size_t(kind)]), in_scene);
  };
  maps->direct.map = build(PhotonKind::kDirect);
  maps->caustic.map = build(PhotonKind::kCaustic);
  maps->indirect.map = build(PhotonKind::kIndirect);
  maps->shadow = build(PhotonKind::kShadow);
}

// r0 for the maps that the plan needs, from those of the first pass.
GatherRadii settle_radii(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                         const EstimatorPlan& plan, const PassShare& pass, const PhotonMaps& maps) {
  const photon::KindMask kinds = kinds_needed(plan);
  const GatherRadii radii = choose_radii(scene, bvh, settings, pass, maps);
  return {kinds.direct || kinds.shadow ? radii.direct : 0, kinds.caustic ? radii.caustic : 0,
          kinds.indirect ? radii.indirect : 0, kinds.caustic ? radii.caustic_nearest : 0};
}

// Sets the radii and k-nearest counts for this pass; both shrink from pass to pass.
void set_estimates(const RenderSettings& settings, const PassShare& pass, const GatherRadii& radii,
                   PhotonMaps* maps) {
  const double squared = maps->shrink.squared(pass.pass, settings.alpha.value_or(1)),
               shrink = std::sqrt(squared);
  const auto shrunk = [&](float radius) { return static_cast<float>(double(radius) * shrink); };
  for (GatherMap* gather : {&maps->direct, &maps->caustic, &maps->indirect}) {
    gather->estimate = estimate_settings(settings, pass);
    gather->estimate.edges = maps->edges.get();
  }
  if (radii.caustic_nearest > 0 && settings.nearest == 0)
    maps->caustic.estimate.nearest = photons_in_reach(radii.caustic_nearest, pass.shares);
  for (GatherMap* gather : {&maps->direct, &maps->caustic, &maps->indirect}) {
    uint32_t& nearest = gather->estimate.nearest;
    // Below kFewestInReach only r0 shrinks on: the K-th photon itself does not count, so K = 1 would see
    // none.
    if (nearest > 0)
      nearest = std::max(std::min(nearest, kFewestInReach), uint32_t(std::lround(nearest * squared)));
  }
  maps->direct.estimate.radius = shrunk(radii.direct);
  maps->caustic.estimate.radius = shrunk(radii.caustic);
  maps->indirect.estimate.radius = shrunk(radii.indirect);
  // M0 is a limit, so it is rounded down.
  maps->lecture = {shrunk(radii.direct), share(settings.node_photons, pass),
                   static_cast<uint32_t>(settings.min_photons / pass.shares)};
}

// The smallest 2^(k/2) metres that is at least the radius. So passes whose radii differ little share the
// areas that are made for it.
float at_least(float radius) {
  int exponent = 0;
  const float mantissa = std::frexp(radius, &exponent);
  return std::ldexp(mantissa <= std::numbers::sqrt2_v<float> / 2 ? std::numbers::sqrt2_v<float> / 2 : 1.0f,
                    exponent);
}

// Areas for this radius: those of another map or of the previous pass if they fit, otherwise new ones.
std::shared_ptr<const photon::SurfaceAreas> areas_for(float radius, const Scene& scene,
                                                      const PhotonMaps& maps) {
  for (const GatherMap* gather : {&maps.direct, &maps.caustic, &maps.indirect})
    if (gather->areas && gather->areas->radius() == radius) return gather->areas;
  return std::make_shared<const photon::SurfaceAreas>(scene, maps.bends, radius);
}

// Sets the areas of curved surfaces for each map. Maps with k-nearest estimates go without: where photons are
// dense their discs are small, and elsewhere surfaces are treated as flat.
void set_areas(const Scene& scene, PhotonMaps* maps) {
  for (GatherMap* gather : {&maps->direct, &maps->caustic, &maps->indirect}) {
    const photon::EstimateSettings& estimate = gather->estimate;
    if (!maps->edges || estimate.nearest > 0 || !(estimate.radius > 0)) continue;
    const float radius = at_least(estimate.radius);
    gather->areas = areas_for(radius, scene, *maps);
    gather->estimate.areas = gather->areas.get();
  }
}

void note_radii(const GatherRadii& radii, RenderStatistics* s) {
  s->direct_radius = radii.direct, s->caustic_radius = radii.caustic, s->indirect_radius = radii.indirect;
  s->radius = std::max({radii.direct, radii.caustic, radii.indirect});
}

void add_sizes(const PhotonMaps& maps, RenderStatistics* s) {
  uint64_t bytes = 0;
  for (const photon::PhotonMap* map :
       {&maps.direct.map, &maps.caustic.map, &maps.indirect.map, &maps.shadow}) {
    bytes += map->memory_bytes();
    s->octree_nodes += map->octree().nodes().size();
  }
  s->photon_bytes = std::max(s->photon_bytes, bytes);
}

void free_maps(PhotonMaps* maps) {
  for (photon::PhotonMap* map : {&maps->direct.map, &maps->caustic.map, &maps->indirect.map, &maps->shadow})
    *map = {};
}

// Finds surface edges and bends, which depend on the scene alone, unless they are there already.
void find_edges(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings, PhotonMaps* maps) {
  if (settings.lookup == Lookup::kLeaf || maps->edges) return;
  maps->edges = std::make_unique<accel::EdgeIndex>(
      accel::without_continued(find_boundary_edges(scene.shapes, &maps->bends), bvh));
}

// One photon for every 32 samples of the image, so that their cost is small compared with the shadow rays
// they save, within the range that is useful.
uint64_t visibility_photons(const Scene& scene, const RenderSettings& settings) {
  constexpr uint64_t kFewest = 1u << 14, kMost = 1u << 18, kSamplesEach = 32;
  const uint64_t pixels =
      static_cast<uint64_t>(scene.camera.width) * static_cast<uint64_t>(scene.camera.height);
  const uint64_t samples = pixels * static_cast<uint64_t>(settings.spp);
  return std::min(settings.photons, std::clamp(samples / kSamplesEach, kFewest, kMost));
}

// Caustic photons that uniform emission leaves on its way to other kinds cost nothing. If their share is at
// least this, guided ones are not worth their rays (docs/decisions/010-guided-photons.md).
constexpr double kEnoughCaustics = 1.0 / 64;

// Learns a guide for one kind, which depends on scene and settings alone. Indirect photons lie wherever there
// is light, even outside a room, so those near visible points count most.
std::unique_ptr<const photon::LearnedGuide> learn_guide(const Scene& scene, const accel::Bvh& bvh,
                                                        const RenderSettings& settings, PhotonKind kind,
                                                        bool beside_others) {
  constexpr uint32_t kPoints = 1u << 14;
  photon::GuideSettings guide{settings.seed, settings.photons, settings.max_bounces, settings.emission, kind};
  if (beside_others) guide.enough = kEnoughCaustics;
  std::optional<VisibleDensity> visible;
  if (kind == PhotonKind::kIndirect) {
    visible.emplace(visible_points(scene, bvh, settings, kPoints));
    guide.importance = [&](const photon::Photon& photon) { return visible->at(photon); };
  }
  return std::make_unique<const photon::LearnedGuide>(photon::learn_guide(scene, bvh, guide));
}

// Learns the guides that the plan needs and that are not there yet. They too depend on scene and settings
// alone.
void learn_guides(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                  const EstimatorPlan& plan, PhotonMaps* maps, RenderStatistics* statistics) {
  if (settings.guide == Guide::kOff) return;
  const photon::KindMask kinds = kinds_needed(plan);
  const Stopwatch watch;
  const auto learn = [&](PhotonKind kind, bool beside_others, auto* guide) {
    if (!kinds[kind]) return;
    if (!*guide) *guide = learn_guide(scene, bvh, settings, kind, beside_others);
    statistics->guide_photons += (*guide)->emitted;
    statistics->guide_hits += (*guide)->hits;
    statistics->guide_boxes += (*guide)->guide.boxes();
  };
  statistics->guide_photons = statistics->guide_hits = statistics->guide_boxes = 0;
  learn(PhotonKind::kIndirect, false, &maps->indirect_guide);
  const bool uniform_indirect = kinds.indirect && maps->indirect_guide->guide.empty();
  learn(PhotonKind::kCaustic, uniform_indirect || kinds.direct || kinds.shadow, &maps->caustic_guide);
  statistics->photon_trace_s += watch.seconds();
}

// One shoot, for some of the kinds.
struct Shoot {
  photon::TraceSettings trace;
  bool guided = false;
};

void take(PhotonKind kind, Shoot* from, Shoot* to) {
  (kind == PhotonKind::kCaustic ? from->trace.kinds.caustic : from->trace.kinds.indirect) = false;
  (kind == PhotonKind::kCaustic ? to->trace.kinds.caustic : to->trace.kinds.indirect) = true;
}

// One shoot for each guided kind, and one for all others.
std::vector<Shoot> plan_shoots(const RenderSettings& settings, const EstimatorPlan& plan,
                               const PassShare& pass, const PhotonMaps& maps) {
  Shoot others{trace_settings(settings, plan, pass)};
  std::vector<Shoot> shoots;
  const auto guide = [&](PhotonKind kind, const auto& learned, uint64_t photons) {
    if (!others.trace.kinds[kind] || !learned || learned->guide.empty()) return;
    Shoot guided{others.trace, true};
    guided.trace.kinds = {};
    guided.trace.guide = &learned->guide;
    guided.trace.photons = photons;
    take(kind, &others, &guided);
    shoots.push_back(guided);
  };
  guide(PhotonKind::kIndirect, maps.indirect_guide, pass.photons);
  guide(PhotonKind::kCaustic, maps.caustic_guide, guided_photons(settings, plan, pass.photons));
  if (others.trace.kinds.any()) shoots.insert(shoots.begin(), others);
  return shoots;
}

void add(const Shoot& shoot, photon::ShootResult&& result, photon::ShootResult* all,
         RenderStatistics* statistics) {
  const photon::TraceCounters& c = result.counters;
  if (shoot.guided)
    statistics->guided += {c.emitted, c.rays, c.dropped_invalid, c.stored};
  else
    statistics->photons += c;
  for (size_t k = 0; k < photon::kPhotonKinds; ++k)
    if (shoot.trace.kinds[PhotonKind(k)]) all->buffers[k] = std::move(result.buffers[k]);
}

// Shoots the photons that the plan needs. False when the progress callback cancelled.
bool shoot_kinds(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                 const EstimatorPlan& plan, const PassShare& pass, const ProgressCallback& progress,
                 const PhotonMaps& maps, photon::ShootResult* shot, RenderStatistics* statistics) {
  const std::vector<Shoot> shoots = plan_shoots(settings, plan, pass, maps);
  uint64_t total = 0, before = 0;
  for (const Shoot& shoot : shoots) total += shoot.trace.photons;
  std::atomic<bool> cancelled{false};
  for (const Shoot& shoot : shoots) {
    const auto told = [&](uint64_t done, uint64_t) {
      const bool go_on = !progress || progress({"photons", before + done, total, pass.pass, pass.shares});
      if (!go_on) cancelled = true;
      return go_on;
    };
    add(shoot, photon::shoot(scene, bvh, shoot.trace, told), shot, statistics);
    if (cancelled) return false;
    before += shoot.trace.photons;
  }
  return true;
}

}  // namespace

photon::KindMask kinds_needed(const EstimatorPlan& plan) {
  photon::KindMask kinds;
  kinds.direct = plan.direct == DirectEstimator::kPhotons || plan.direct == DirectEstimator::kLecture;
  kinds.shadow = plan.direct == DirectEstimator::kLecture || plan.direct == DirectEstimator::kSigned;
  kinds.caustic = plan.caustics == CausticEstimator::kPhotons;
  kinds.indirect = plan.indirect == IndirectEstimator::kPhotons;
  return kinds;
}

void predict_visibility(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                        const EstimatorPlan& plan, PhotonMaps* maps, RenderStatistics* statistics) {
  if (plan.direct != DirectEstimator::kPredicted || maps->visibility) return;
  const Stopwatch watch;
  maps->visibility = std::make_unique<const photon::VisibilityTree>(photon::predict_visibility(
      scene, bvh, {settings.seed, visibility_photons(scene, settings), settings.emission}));
  statistics->photon_trace_s += watch.seconds();
}

uint64_t guided_photons(const RenderSettings& settings, const EstimatorPlan& plan, uint64_t photons) {
  photon::KindMask kinds = kinds_needed(plan);
  if (!kinds.caustic || settings.guide == Guide::kOff) return 0;
  kinds.caustic = false;
  return kinds.any() ? (photons + 1) / 2 : photons;
}

bool make_photon_maps(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                      const EstimatorPlan& plan, const PassShare& pass, const ProgressCallback& progress,
                      PhotonMaps* maps, std::optional<GatherRadii>* radii, RenderStatistics* statistics) {
  if (!kinds_needed(plan).any()) return true;
  learn_guides(scene, bvh, settings, plan, maps, statistics);
  free_maps(maps);
  const Stopwatch watch;
  photon::ShootResult shot;
  const bool finished = shoot_kinds(scene, bvh, settings, plan, pass, progress, *maps, &shot, statistics);
  statistics->photon_trace_s += watch.seconds();
  if (!finished) return false;

  const Stopwatch build_watch;
  build_maps(scene, std::move(shot), maps);
  if (!*radii) *radii = settle_radii(scene, bvh, settings, plan, pass, *maps);
  find_edges(scene, bvh, settings, maps);
  set_estimates(settings, pass, **radii, maps);
  set_areas(scene, maps);
  note_radii(**radii, statistics);
  add_sizes(*maps, statistics);
  statistics->photon_build_s += build_watch.seconds();
  return !progress || progress({"build", 1, 1, pass.pass, pass.shares});
}

}  // namespace kaustik::render
