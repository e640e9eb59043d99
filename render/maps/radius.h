#pragma once
// Chooses the gather radius r0 of each map when the user gives none.

#include <algorithm>

#include "render/explore/visible_points.h"
#include "render/maps/gather_radii.h"
#include "render/maps/photon_maps.h"
#include "render/plan/pass_share.h"
#include "render/plan/render_input.h"

namespace kaustik::render {

// k-nearest searches look for at least this many photons unless fewer were requested: the distance of fewer
// says little.
inline constexpr uint32_t kFewestInReach = 8;

// Number of photons of one pass that corresponds to `of_all` photons of all passes.
inline uint32_t photons_in_reach(uint32_t of_all, uint64_t passes) {
  const uint64_t rounded = (of_all + passes / 2) / passes;
  return static_cast<uint32_t>(
      std::clamp<uint64_t>(rounded, std::min<uint64_t>(kFewestInReach, of_all), of_all));
}

// Median, over the points, of the distance to the k-th nearest photon, where k is `photons` of all passes; a
// fixed fraction of `reach`, in which photons are looked for, if there are too few.
float radius_with_photons(const photon::PhotonMap& map, const std::vector<VisiblePoint>& points, float reach,
                          uint32_t photons, const PassShare& pass);

// How many of this many indirect photons should be in reach of an estimate.
double photons_in_reach_of_indirect(double photons);

// The highest gap below a wall that does not join the discs on both sides: a quarter of their radius, rounded
// down to a power of two, so that maps of a few more photons find the same feet.
float gap_below_walls(float radius);

// Returns settings.radius for every map, if it is set; otherwise settings.radius_factor times a choice from
// the photons: the median distance to the k-th nearest photon, where k ~ M^(2/3) for M photons of all passes
// balances noise and bias. Direct map (k = 160 for a million photons, at least 64) and indirect map (500,
// 200; of all photons, where paths find some of the light; kIndirectReach times the distance): around 1024
// points that the camera sees. Caustic
// map (232, 24), and the shadow map if it replaces the direct one: around 1024 of its photons that divide its
// flux evenly, since caustics and shadows are small. Caustics are sharp where they focus and sparse
// elsewhere, so no single radius suits both: for them r0 is four times as large, the radius that no photon's
// own disc exceeds (photon/gather/photon_discs.h); for the leaf lookup it is twice as large and shrinks to
// the k-th nearest photon. So does the radius of the direct map, to the 2 k-th, where photons give the direct
// light: light near a lamp is bright. k is smaller for maps with fewer photons. Deterministic: a function of
// scene and settings only, and scales exactly with the scene for powers of two. maps are those of the first
// pass, which holds one in pass.shares of the photons; k is divided accordingly.
GatherRadii choose_radii(const RenderInput& input, const PassShare& pass, const PhotonMaps& maps);

}  // namespace kaustik::render
