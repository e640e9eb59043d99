// Shoots the photons and estimates the light of each place.

#include "render/maps/path_ends.h"

#include <algorithm>

#include "accel/wall_feet.h"
#include "core/parallel/parallel.h"
#include "photon/estimate/radiance_estimate.h"
#include "photon/shoot/guide_shoot.h"
#include "render/explore/visible_density.h"
#include "render/maps/radius.h"

namespace kaustik::render {

namespace {

using photon::PhotonKind;

// Separates the random numbers of these photons from all others.
constexpr uint64_t kEndsPass = 0x656e647300000000;
// Photons in reach of an estimate at the median place. A point of the picture is lit by many places, so that
// their noise averages out.
constexpr uint32_t kInReach = 16;
// Cells of places as a share of the discs' radius, and how many there may be along an axis.
constexpr float kOfRadius = 0.5f, kMostCells = 60'000;
// One photon is to be left for so many rays that may be traced.
constexpr uint64_t kRaysOfLeft = 8;

uint64_t per_pixel(uint64_t count, const Camera& camera, uint64_t fewest, uint64_t most) {
  return std::clamp(count * uint64_t(camera.width) * uint64_t(camera.height), fewest, most);
}

// Rays of the photons: they take as long as a few samples of each pixel of a small picture. Larger ones have
// no other light.
uint64_t most_rays(const Camera& camera) {
  return per_pixel(128, camera, 1u << 16, 1u << 22);
}

// Places to look for.
uint32_t most_places(const Camera& camera) {
  return uint32_t(per_pixel(4, camera, 1u << 14, 1u << 16));
}

photon::LearnedGuide learn_guide(const RenderInput& input, uint64_t photons, const photon::SourceSplit* split,
                                 const std::vector<VisiblePoint>& places) {
  const RenderSettings& s = input.settings;
  const VisibleDensity density(places);
  photon::GuideSettings guide{s.seed, photons, s.max_bounces, s.emission, PhotonKind::kIndirect};
  guide.split = split;
  guide.split_caustics = guide.of_paths = true;
  guide.importance = [&](PhotonKind, const photon::Photon& photon) { return density.at(photon); };
  return photon::learn_guide(input.scene, input.bvh, guide);
}

photon::TraceSettings trace_settings_of(const RenderInput& input, const photon::SourceSplit* split,
                                        const photon::EmissionGuide& guide) {
  photon::TraceSettings trace;
  trace.seed = input.settings.seed;
  trace.pass = kEndsPass;
  trace.max_bounces = input.settings.max_bounces;
  trace.emission = input.settings.emission;
  trace.guide = guide.empty() ? nullptr : &guide;
  trace.split = split;
  trace.split_caustics = trace.split_indirect = trace.of_paths = true;
  trace.kinds.caustic = trace.kinds.indirect = true;
  return trace;
}

// Few photons tell how many leave the wanted number within the rays.
uint64_t photons_within(const RenderInput& input, photon::TraceSettings trace, uint64_t rays) {
  constexpr uint64_t kFew = 1u << 12;
  trace.photons = kFew;
  ++trace.pass;
  const photon::TraceCounters few = photon::shoot(input.scene, input.bvh, trace).counters;
  const uint64_t left = kRaysOfLeft * few.stored[size_t(PhotonKind::kIndirect)];
  return 1 + kFew * rays / std::max<uint64_t>({1, left, few.rays});
}

photon::PhotonMap shoot_map(const RenderInput& input, photon::TraceSettings trace, uint64_t rays,
                            const photon::ShootProgress& progress) {
  trace.photons = photons_within(input, trace, rays);
  photon::ShootResult shot = photon::shoot(input.scene, input.bvh, trace, progress);
  return photon::PhotonMap::build(std::move(shot.buffers[size_t(PhotonKind::kIndirect)]),
                                  photon::MapSettings{input.scene.bounds});
}

std::vector<VisiblePoint> first_of(const std::vector<VisiblePoint>& places, size_t count) {
  return {places.begin(), places.begin() + std::ptrdiff_t(std::min(count, places.size()))};
}

// What the places scatter, were they white.
std::vector<Rgb> estimate(const std::vector<VisiblePoint>& places, const photon::PhotonMap& map,
                          const photon::EstimateSettings& settings) {
  const Bsdf white = Lambertian{Rgb(1)};
  std::vector<Rgb> radiance(places.size());
  parallel::for_index(size_t{0}, places.size(), [&](size_t i) {
    SurfaceInteraction si = places[i].si;
    si.ns = si.n;
    photon::GatherCounters ignored;
    radiance[i] = photon::estimate_radiance(map, si, places[i].query.n, white, settings, ignored);
  });
  return radiance;
}

}  // namespace

PathEnds::PathEnds(const RenderInput& input, const photon::SourceSplit* split, const accel::EdgeIndex& edges,
                   const std::vector<SurfaceBend>& bends, const photon::ShootProgress& progress) {
  constexpr size_t kGuidePlaces = 1u << 14, kRadiusPlaces = 1u << 10;
  const Scene& scene = input.scene;
  const uint64_t rays = most_rays(scene.camera);
  // They do not depend on the photons, so that where there is an estimate tells nothing about its value.
  std::vector<VisiblePoint> places = points_behind_visible(input, most_places(scene.camera));
  if (places.empty()) return;
  const photon::LearnedGuide learned = learn_guide(input, rays / 2, split, first_of(places, kGuidePlaces));
  const photon::PhotonMap map =
      shoot_map(input, trace_settings_of(input, split, learned.guide), rays, progress);
  if (map.empty()) return;
  radius_ = radius_with_photons(map, first_of(places, kRadiusPlaces), 2 * scene.bounds.radius(), kInReach,
                                pass_share(0, 1, 1, 1));
  const photon::SurfaceAreas areas(scene, bends, radius_);
  const photon::Walls walls(accel::find_wall_feet(scene, edges, gap_below_walls(radius_)), scene.bounds,
                            radius_);
  photon::EstimateSettings settings;
  settings.radius = radius_, settings.edges = &edges, settings.areas = &areas, settings.walls = &walls;
  grid_ = PlaceGrid(places, std::min(kMostCells, longest_side(places) / (kOfRadius * radius_)));
  const auto key_of = [&](const VisiblePoint& p) { return key(p.query.p, p.query.n, p.query.surface_group); };
  std::erase_if(places, [&](const VisiblePoint& p) { return !radiance_.try_emplace(key_of(p)).second; });
  const std::vector<Rgb> radiance = estimate(places, map, settings);
  for (size_t i = 0; i < places.size(); ++i) radiance_[key_of(places[i])] = radiance[i];
}

uint64_t PathEnds::most_bytes(const Camera& camera) {
  // The map is built beside the records that were shot. A place is in the list, and in the table with its
  // node.
  constexpr uint64_t kOfPhoton = 3 * sizeof(photon::PhotonRecord);
  constexpr uint64_t kOfPlace = 2 * sizeof(std::optional<VisiblePoint>) + 64;
  return most_rays(camera) / kRaysOfLeft * kOfPhoton + most_places(camera) * kOfPlace;
}

}  // namespace kaustik::render
