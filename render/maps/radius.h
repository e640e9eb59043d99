#pragma once
// The gather radius r0 of each map when the user gives none.

#include "render/maps/photon_maps.h"

namespace kaustik::render {

// Fewer photons are not searched for, unless fewer were asked for: their distance would say nothing.
inline constexpr uint32_t kFewestInReach = 8;

// How many of a pass's photons stand for so many of all.
inline uint32_t photons_in_reach(uint32_t of_all, uint64_t passes) {
  const uint64_t rounded = (of_all + passes / 2) / passes;
  return static_cast<uint32_t>(
      std::clamp<uint64_t>(rounded, std::min<uint64_t>(kFewestInReach, of_all), of_all));
}

// settings.radius for every map, or settings.radius_factor times a choice from the photons: the median
// distance to the k-th nearest photon, k ~ M^(2/3) for M photons of all passes, where noise and bias balance.
// Direct (k = 160 for a million, at least 64) and indirect map (500, 200): around 1024 points that the camera
// sees. Caustic map (232, 8), and the shadow map where it is read in place of the direct one: around 1024 of
// its photons, evenly spaced in their light, since caustics and shadows are small. Caustics are sharp where
// they focus and spread thin elsewhere, so that no single radius serves both: there r0 is twice as large, and
// the radius shrinks to the k-th nearest photon, without --radius and --nearest. Fewer neighbours where a map
// has fewer photons. Deterministic, a function of scene and settings only; scales with the scene exactly for
// powers of two. maps are those of the first pass, which holds one in pass.shares of the photons: k is
// divided accordingly.
GatherRadii choose_radii(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                         const PassShare& pass, const PhotonMaps& maps);

}  // namespace kaustik::render
