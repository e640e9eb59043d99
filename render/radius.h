#pragma once
// The gather radius r0 of each map when the user gives none.

#include "render/photon_maps.h"

namespace kaustik::render {

struct GatherRadii {
  float direct = 0, caustic = 0, indirect = 0;  // metres; 0 for maps without photons
};

// Without --radius and --nearest the caustic map is read with the distance to its so-manieth photon, at most
// the radius below: caustics are sharp where they focus and spread thin elsewhere, so that no single radius
// serves both.
inline constexpr uint32_t kCausticNearest = 50;

// settings.radius for every map, or chosen from the photons: the median distance to the k-th nearest photon.
// Direct (k = 64) and indirect map (k = 256): around 1024 points that the camera sees. Caustic map (k =
// kCausticNearest): around 1024 of its photons, since caustics are small. Fewer neighbours where a map has
// fewer photons. Deterministic, a function of scene and settings only; scales with the scene exactly for
// powers of two.
GatherRadii choose_radii(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                         const PhotonMaps& maps);

}  // namespace kaustik::render
