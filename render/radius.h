#pragma once
// The gather radius r0 of each map when the user gives none.

#include "render/photon_maps.h"

namespace kaustik::render {

// Without --radius and --nearest the caustic map is read with the distance to its so-manieth photon, at most
// the radius below: caustics are sharp where they focus and spread thin elsewhere, so that no single radius
// serves both.
inline constexpr uint32_t kCausticNearest = 50;

// settings.radius for every map, or settings.radius_factor times a choice from the photons: the median
// distance to the k-th nearest photon. Direct (k = 64) and indirect map (k = 256): around 1024 points that
// the camera sees. Caustic map (k = kCausticNearest), and the shadow map where it is read in place of the
// direct one (k = 64): around 1024 of its photons, since caustics and shadows are small. Fewer neighbours
// where a map has fewer photons. Deterministic, a function of scene and settings only; scales with the scene
// exactly for powers of two. maps are those of the first pass, which holds one in pass.shares of the photons:
// k is divided accordingly.
GatherRadii choose_radii(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                         const PassShare& pass, const PhotonMaps& maps);

// The so-manieth photon to which the caustic map's radius shrinks in a pass: kCausticNearest, times the
// square of settings.radius_factor.
uint32_t caustic_nearest(const RenderSettings& settings, const PassShare& pass);

// Fewer photons are not searched for, unless fewer were asked for: their distance would say nothing.
inline constexpr uint32_t kFewestInReach = 8;

// How many of a pass's photons stand for so many of all.
inline uint32_t photons_in_reach(uint32_t of_all, uint64_t passes) {
  const uint64_t rounded = (of_all + passes / 2) / passes;
  return static_cast<uint32_t>(
      std::clamp<uint64_t>(rounded, std::min<uint64_t>(kFewestInReach, of_all), of_all));
}

}  // namespace kaustik::render
