// Builds the maps of a pass and sets how they are gathered.

#include "render/maps/pass_photons.h"

#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <utility>

#include "accel/wall_feet.h"
#include "core/geometry/merge_edges.h"
#include "core/parallel/work_span.h"
#include "core/stopwatch.h"
#include "photon/visibility/visibility_shoot.h"
#include "render/maps/radius.h"

namespace kaustik::render {

namespace {

// The radius of a render as a share of that of a trial, whose photons are a quarter or less of the render's.
constexpr float kTrialShrink = 0.5f;

using photon::PhotonKind;

std::array<GatherMap*, 3> gather_maps(PhotonMaps& maps) {
  return {&maps.direct, &maps.caustic, &maps.indirect};
}

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

// Whether discs of indirect photons may be narrower where other surfaces are near.
bool follows_clearance(const RenderSettings& settings) {
  return settings.nearest == 0 && settings.lookup != Lookup::kLeaf;
}

// r0 for the maps that the plan needs, from those of the first pass.
GatherRadii settle_radii(const RenderInput& input, const PassShare& pass, const PhotonMaps& maps) {
  const photon::KindMask kinds = kinds_needed(input.plan);
  const GatherRadii radii = choose_radii(input, pass, maps);
  return {kinds.direct || kinds.shadow ? radii.direct : 0,
          kinds.caustic ? radii.caustic : 0,
          kinds.indirect ? radii.indirect : 0,
          kinds.caustic ? radii.caustic_nearest : 0,
          radii.direct_nearest,
          kinds.medium_caustic ? radii.medium_caustic : 0,
          kinds.medium_indirect ? radii.medium_indirect : 0,
          kinds.medium_caustic ? radii.medium_caustic_nearest : 0,
          kinds.medium_indirect ? radii.medium_indirect_nearest : 0,
          kinds.indirect ? radii.indirect_widest : 0};
}

// At an edge the squared bias of a disc of radius r goes like r, so that r ~ M^(-1/3) balances it with the
// noise, and M^(1/3) photons are in the disc: the root of the M^(2/3) of even light. Measured
// (docs/decisions/064-caustic-photons-have-discs-of-their-own.md). nearest: M^(2/3) of all passes; squared:
// how much this pass has shrunk them.
photon::DiscRule disc_rule(uint32_t nearest, float largest, double squared, const RenderSettings& settings,
                           const PassShare& pass) {
  constexpr double kFewestOfRoot = 8.5, kMostOfNearest = 2;
  // The rule's photons without the factor of the radius; they follow its square.
  const double factor = double(settings.radius_factor) * double(settings.radius_factor);
  const auto of_pass = [&](double of_all) {
    return std::max(kFewestInReach, uint32_t(std::lround(of_all * squared / double(pass.shares))));
  };
  return {of_pass(kFewestOfRoot * factor * std::sqrt(nearest / factor)), of_pass(kMostOfNearest * nearest),
          largest};
}

// The smallest 2^(k/2) metres that is at least the radius. So passes whose radii differ little share the
// areas that are made for it.
float at_least(float radius) {
  int exponent = 0;
  const float mantissa = std::frexp(radius, &exponent);
  return std::ldexp(mantissa <= std::numbers::sqrt2_v<float> / 2 ? std::numbers::sqrt2_v<float> / 2 : 1.0f,
                    exponent);
}

void add_sizes(const PhotonMaps& maps, RenderStatistics* s) {
  uint64_t bytes = 0;
  for (size_t k = 0; k < photon::kPhotonKinds; ++k) {
    const photon::PhotonMap& map = maps.of(PhotonKind(k));
    bytes += map.memory_bytes();
    s->octree_nodes += map.octree().nodes().size();
  }
  if (maps.caustic.discs) bytes += maps.caustic.discs->memory_bytes();
  s->photon_bytes = std::max(s->photon_bytes, bytes);
}

// One photon for every 32 samples of the image, so that their cost is small compared with the shadow rays
// they save, within the range that is useful.
uint64_t visibility_photons(const Camera& camera, const RenderSettings& settings) {
  constexpr uint64_t kFewest = 1u << 14, kMost = 1u << 18, kSamplesEach = 32;
  const uint64_t pixels = static_cast<uint64_t>(camera.width) * static_cast<uint64_t>(camera.height);
  const uint64_t samples = pixels * static_cast<uint64_t>(settings.spp);
  return std::min(settings.photons, std::clamp(samples / kSamplesEach, kFewest, kMost));
}

}  // namespace

// Builds the maps of surfaces in one cube, since the lecture's test compares direct and shadow photons of the
// same cell. Fog may reach far beyond the scene's surfaces, and so do photons there.
void PassPhotons::build_maps(const RenderInput& input, photon::ShootResult&& shot) {
  const photon::MapSettings in_scene{input.scene.bounds};
  for (size_t k = 0; k < photon::kPhotonKinds; ++k) {
    const bool in_medium = k >= size_t(PhotonKind::kMediumCaustic);
    maps_.of(PhotonKind(k)) =
        photon::PhotonMap::build(std::move(shot.buffers[k]), in_medium ? photon::MapSettings{} : in_scene);
  }
}

void PassPhotons::free_maps() {
  for (size_t k = 0; k < photon::kPhotonKinds; ++k) maps_.of(PhotonKind(k)) = {};
  maps_.caustic.discs = nullptr;
  maps_.caustic.estimate.discs = nullptr;
}

bool PassPhotons::explore(const RenderInput& input, const ProgressCallback& progress) {
  if (!kinds_needed(input.plan).any() && !input.plan.ends_paths) return true;
  ExploredScene& known = *explored_;
  const Stopwatch watch;
  bool cancelled = false;
  const auto go_on = [&] {
    cancelled = progress && !progress({"build", 0, 1});
    return !cancelled;
  };
  if (!known.edges) {
    std::vector<BoundaryEdge> edges = find_boundary_edges(input.scene.shapes, &known.bends);
    edges = accel::without_continued(std::move(edges), input.bvh, go_on);
    if (cancelled) return false;
    known.edges = std::make_unique<accel::EdgeIndex>(merge_edges(std::move(edges)));
  }
  known.seconds += watch.seconds();
  return true;
}

// Finds the feet of walls for the radii of the first pass of this process; later passes have smaller discs.
// The feet that a trial finds serve the render if its photons turn out to ask for the same gap, so a trial
// looks for those of a smaller radius than its own.
void PassPhotons::find_walls(const Scene& scene) {
  if (std::exchange(walls_are_known_, true)) return;
  const float radius = std::max({radii_->direct, radii_->caustic, radii_->indirect});
  if (!(radius > 0) || !std::isfinite(radius)) return;
  const float gap = gap_below_walls(is_trial_ ? kTrialShrink * radius : radius);
  std::optional<WallFeet>& feet = explored_->feet;
  if (!feet || feet->gap != gap) feet = WallFeet{gap, accel::find_wall_feet(scene, *explored_->edges, gap)};
  if (!feet->edges.empty()) walls_ = std::make_unique<photon::Walls>(feet->edges, scene.bounds, radius);
}

// Sets the radii and k-nearest counts for this pass; both shrink from pass to pass.
void PassPhotons::set_estimates(const RenderInput& input, const PassShare& pass) {
  const RenderSettings& settings = input.settings;
  const double squared = shrink_.squared(pass.pass, settings.alpha.value_or(1)), shrink = std::sqrt(squared);
  const auto shrunk = [&](float radius) { return static_cast<float>(double(radius) * shrink); };
  for (GatherMap* gather : gather_maps(maps_)) {
    gather->estimate = estimate_settings(settings, pass);
    if (settings.lookup != Lookup::kLeaf) gather->estimate.edges = explored_->edges.get();
    gather->estimate.walls = walls_.get();
  }
  const auto set_nearest = [&](uint32_t nearest, GatherMap* gather) {
    if (nearest > 0 && settings.nearest == 0)
      gather->estimate.nearest = photons_in_reach(nearest, pass.shares);
  };
  set_nearest(radii_->caustic_nearest, &maps_.caustic);
  set_nearest(radii_->direct_nearest, &maps_.direct);
  const auto set_beams = [&](uint32_t nearest, GatherMap* gather) {
    gather->estimate = {};
    gather->estimate.kernel = maps_.indirect.estimate.kernel;
    if (settings.nearest > 0) gather->estimate.nearest = photons_in_reach(settings.nearest, pass.shares);
    set_nearest(nearest, gather);
  };
  set_beams(radii_->medium_caustic_nearest, &maps_.medium_caustic);
  set_beams(radii_->medium_indirect_nearest, &maps_.medium_indirect);
  for (GatherMap* gather :
       {&maps_.direct, &maps_.caustic, &maps_.indirect, &maps_.medium_caustic, &maps_.medium_indirect}) {
    uint32_t& nearest = gather->estimate.nearest;
    // Below kFewestInReach only r0 shrinks on: the K-th photon itself does not count, so K = 1 would see
    // none.
    if (nearest > 0)
      nearest = std::max(std::min(nearest, kFewestInReach), uint32_t(std::lround(nearest * squared)));
  }
  maps_.direct.estimate.radius = shrunk(radii_->direct);
  maps_.caustic.estimate.radius = shrunk(radii_->caustic);
  const bool all_alike = radii_->indirect_widest > 0 && !follows_clearance(settings);
  maps_.indirect.estimate.radius = shrunk(all_alike ? radii_->indirect / kIndirectReach : radii_->indirect);
  maps_.medium_caustic.estimate.radius = shrunk(radii_->medium_caustic);
  maps_.medium_indirect.estimate.radius = shrunk(radii_->medium_indirect);
  // M0 is a limit, so it is rounded down.
  maps_.lecture = {shrunk(radii_->direct), share(settings.node_photons, pass),
                   static_cast<uint32_t>(settings.min_photons / pass.shares)};
}

// Areas for this radius: those of another map or of the previous pass if they fit, otherwise new ones.
std::shared_ptr<const photon::SurfaceAreas> PassPhotons::areas_for(float radius, const Scene& scene) const {
  for (const GatherMap* gather : {&maps_.direct, &maps_.caustic, &maps_.indirect})
    if (gather->areas && gather->areas->radius() == radius) return gather->areas;
  return std::make_shared<const photon::SurfaceAreas>(scene, explored_->bends, radius);
}

// Sets the areas of curved surfaces for each map. Caustics go without, and so do maps of --nearest: where
// photons are dense their discs are small, and elsewhere surfaces are treated as flat. Most discs of direct
// photons have the full radius.
void PassPhotons::set_areas(const Scene& scene) {
  for (GatherMap* gather : gather_maps(maps_)) {
    const photon::EstimateSettings& estimate = gather->estimate;
    const bool full = estimate.nearest == 0 || (gather == &maps_.direct && radii_->direct_nearest > 0);
    if (!estimate.edges || !full || !(estimate.radius > 0)) continue;
    const float radius = at_least(estimate.radius);
    gather->areas = areas_for(radius, scene);
    gather->estimate.areas = gather->areas.get();
  }
}

// Gives each caustic photon a disc of its own, unless the user asks for a radius, for the nearest photons or
// for the lecture's cells: caustics are sharp where they focus and thin elsewhere.
void PassPhotons::set_discs(const RenderSettings& settings, const PassShare& pass) {
  GatherMap& caustic = maps_.caustic;
  caustic.discs = nullptr;
  if (radii_->caustic_nearest > 0 && settings.nearest == 0 && settings.lookup != Lookup::kLeaf) {
    const double squared = shrink_.squared(pass.pass, settings.alpha.value_or(1));
    caustic.discs = std::make_shared<const photon::PhotonDiscs>(
        caustic.map, disc_rule(radii_->caustic_nearest, caustic.estimate.radius, squared, settings, pass));
  }
  caustic.estimate.discs = caustic.discs.get();
}

// Narrows the discs of indirect photons where other surfaces are near.
void PassPhotons::set_clearance(const RenderInput& input, const PassShare& pass) {
  GatherMap& indirect = maps_.indirect;
  indirect.clear = nullptr;
  if (radii_->indirect_widest > 0 && follows_clearance(input.settings)) {
    const double squared = shrink_.squared(pass.pass, input.settings.alpha.value_or(1));
    indirect.clear = std::make_shared<const photon::ClearRadius>(input.bvh, indirect.estimate.radius,
                                                                 double(radii_->indirect_widest) * squared);
  }
  indirect.estimate.clear = indirect.clear.get();
}

bool PassPhotons::make(const RenderInput& input, const PassShare& pass, const ProgressCallback& progress,
                       RenderStatistics* statistics) {
  if (!kinds_needed(input.plan).any()) return true;
  if (const auto known = std::exchange(explored_->guides, nullptr)) guides_ = std::move(*known);
  learn_guides(input, &guides_, statistics);
  learn_segments(input, &guides_, statistics);
  free_maps();
  photon::ShootResult shot;
  if (!shoot_kinds(input, pass, guides_, progress, &shot, statistics)) return false;

  const PhaseWatch watch;
  build_maps(input, std::move(shot));
  const auto in_this_pass = [&](Progress p) {
    p.pass = pass.pass, p.passes = pass.shares;
    return !progress || progress(p);
  };
  if (!explore(input, in_this_pass)) return false;
  prepare_gathers(input, pass);
  note_radii(*radii_, statistics);
  add_sizes(maps_, statistics);
  statistics->photon_build_s += watch.end("photon_build");
  return !progress || progress({"build", 1, 1, pass.pass, pass.shares});
}

void PassPhotons::adopt(const RenderInput& input, KeptPhotons&& kept, bool radii_known,
                        RenderStatistics* statistics) {
  const PhaseWatch watch;
  const RenderSettings& settings = input.settings;
  for (size_t k = 0; k < kept.maps.size(); ++k) maps_.of(PhotonKind(k)) = std::move(kept.maps[k]);
  if (radii_known) radii_ = kept.radii;
  explore(input);
  prepare_gathers(input, pass_share(0, 1, settings.photons, settings.spp));
  *statistics = kept.statistics;
  note_radii(*radii_, statistics);
  statistics->photon_build_s += watch.end("photon_build");
}

KeptPhotons PassPhotons::keep(const RenderStatistics& statistics) const {
  KeptPhotons kept{.radii = *radii_, .statistics = statistics};
  kept.statistics.photon_trace_s = kept.statistics.photon_build_s = 0;  // equal photons give equal files
  for (size_t k = 0; k < kept.maps.size(); ++k) kept.maps[k] = maps_.of(PhotonKind(k));
  return kept;
}

// Chooses r0 unless it is known, and sets how the maps are gathered.
void PassPhotons::prepare_gathers(const RenderInput& input, const PassShare& pass) {
  maps_.split = guides_.split.get();
  if (!radii_) radii_ = settle_radii(input, pass, maps_);
  find_walls(input.scene);
  set_estimates(input, pass);
  set_areas(input.scene);
  set_discs(input.settings, pass);
  set_clearance(input, pass);
}

void PassPhotons::choose_radii_anew(const RenderInput& input, const PassShare& pass) {
  if (!radii_) return;       // no photons, or cancelled
  forget_radii_and_walls();  // areas for the same radius serve on
  prepare_gathers(input, pass);
}

void PassPhotons::forget_radii_and_walls() {
  radii_.reset();
  walls_.reset();
  walls_are_known_ = false;
}

void PassPhotons::predict_visibility(const RenderInput& input, RenderStatistics* statistics) {
  if (input.plan.direct != DirectEstimator::kPredicted || visibility_) return;
  const PhaseWatch watch;
  const RenderSettings& settings = input.settings;
  visibility_ = std::make_unique<const photon::VisibilityTree>(photon::predict_visibility(
      input.scene, input.bvh,
      {settings.seed, visibility_photons(input.scene.camera, settings), settings.emission}));
  statistics->photon_trace_s += watch.end("photon_trace");
}

bool PassPhotons::end_paths(const RenderInput& input, const ProgressCallback& progress,
                            RenderStatistics* statistics) {
  if (ends_ || !input.plan.ends_paths) return true;
  const bool divided = input.plan.indirect == IndirectEstimator::kSplit;
  const photon::SourceSplit* const split = divided && guides_.split ? &guides_.split->sources : nullptr;
  if (divided && !(split && split->leaves_to_paths())) return true;
  const PhaseWatch watch;
  if (!explore(input, progress)) return false;
  std::atomic<bool> cancelled{false};
  const auto told = [&](uint64_t done, uint64_t total) {
    if (progress && !progress({"photons", done, total})) cancelled = true;
    return !cancelled;
  };
  auto ends = std::make_unique<const PathEnds>(input, split, *explored_->edges, explored_->bends, told);
  statistics->photon_trace_s += watch.end("photon_trace");
  if (cancelled) return false;
  ends_ = std::move(ends);
  maps_.ends = ends_->empty() ? nullptr : ends_.get();
  return true;
}

void PassPhotons::learn_sky(const RenderInput& input, RenderStatistics* statistics) {
  if (input.settings.method != Method::kAuto || input.scene.infinite_lights.empty()) return;
  if (explored_->sky) return;
  const PhaseWatch watch;
  explored_->sky = std::make_unique<const SkyGuide>(input);
  statistics->photon_trace_s += watch.end("photon_trace");
}

}  // namespace kaustik::render
