#pragma once
// Photons near a ray, for light that media scatter along it. Which photons count is decided without fused
// operations, so it is the same on every instruction set. All functions are thread-safe.

#include "core/math/ray.h"
#include "core/medium/medium.h"
#include "photon/gather/beam_sight.h"
#include "photon/gather/gather_query.h"
#include "photon/gather/kernel.h"
#include "photon/map/photon_map.h"

namespace kaustik::photon {

// A photon counts if it is within radius of the ray (d <= radius, metres), abreast of a point of it, and in
// this medium (modulo 2^16).
struct BeamQuery {
  Ray ray;             // unit direction
  float distance = 0;  // length of the ray, metres, may be infinite
  float radius = 0;    // metres
  uint32_t medium = 0;
  const ColumnTable* columns = nullptr;  // of the ray, where the medium's density changes; else null
  const BeamSight* sight = nullptr;      // what gather_along() takes surfaces to hide; null: nothing
};

// Photons that count, in ascending order of the map: their indices, places on the ray in metres from its
// start, and squared distances from it.
struct BeamPhotons {
  const uint32_t* index;
  const float *t, *distance_squared;
  size_t size;
};
using TakeBeamPhotons = void (*)(void* to, const BeamPhotons& photons);

// Calls take(to, photons) for the photons that count, some at a time.
void select_along(const PhotonMap& map, const BeamQuery& query, GatherCounters& counters,
                  TakeBeamPhotons take, void* to);

// Number of photons that count.
uint64_t count_along(const PhotonMap& map, const BeamQuery& query);

// A gather along a ray counts as one query and one more for so many candidates: it takes as long as that many
// gathers on a disc, and adaptive samples go by the number of queries.
inline constexpr uint64_t kCandidatesOfQuery = 256;

// Sum over the photons that count of  T(t) p(wi, -d) K(distance) flux, in W/(m^2 sr), where d is the ray's
// direction. The order of the sum is fixed. query.sight: photons count where the ray sees them, divided by
// the share of the kernel that it sees. One photon of a block, chosen in proportion to its part of the sum,
// decides for all of the block, so that the sum is right in the mean.
Rgb gather_along(const PhotonMap& map, const BeamQuery& query, const Medium& medium, const KernelSpec& kernel,
                 GatherCounters& counters);

}  // namespace kaustik::photon
