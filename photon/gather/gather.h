#pragma once
// Gathers over a photon map. Which photons count is decided without fused operations, so it is the same on
// every instruction set; only the order of the sum depends on it. All functions are thread-safe.

#include "photon/gather/gather_query.h"
#include "photon/gather/kernel.h"
#include "photon/map/photon_map.h"

namespace kaustik::photon {

// Returns the sum of flux K(d) over the photons that count, in W/m^2. The order of the sum is fixed.
Rgb gather_flux(const PhotonMap& map, const GatherQuery& query, const KernelSpec& kernel,
                GatherCounters& counters);

// Calls fn(const Photon&, float distance_squared) for each photon that counts, in Morton order.
template <class Fn>
void for_each_photon(const PhotonMap& map, const GatherQuery& query, Fn&& fn, GatherCounters& counters);

namespace detail {

// Sums of the SIMD loops.
struct GatherSum {
  glm::dvec3 flux{
      0};  // in flux units times the kernel's weight: multiply by KernelTerms::scale and flux_unit
  uint64_t accepted = 0, candidates = 0;
};

// Nodes of the box tree at which the search for the query's photons begins.
inline BoxTree::Start start_of(const PhotonMap& map, const GatherQuery& query) {
  return map.boxes().start_at(map.octree().ranges_near(query.p, query.radius, query.within));
}

// Calls take(to, ...) with the indices of the photons that count, in ascending order, and their squared
// distances. Adds to candidates and accepted.
using TakePhotons = void (*)(void* to, const uint32_t* index, const float* distance_squared, size_t count);
void select_photons(const PhotonMap& map, const GatherQuery& query, GatherCounters& counters,
                    TakePhotons take, void* to);

}  // namespace detail

template <class Fn>
void for_each_photon(const PhotonMap& map, const GatherQuery& query, Fn&& fn, GatherCounters& counters) {
  ++counters.queries;
  const auto take = [&](const uint32_t* index, const float* distance_squared, size_t count) {
    for (size_t i = 0; i < count; ++i) fn(map.photon(index[i]), distance_squared[i]);
  };
  using Take = decltype(take);
  detail::select_photons(
      map, query, counters,
      [](void* to, const uint32_t* index, const float* distance_squared, size_t count) {
        (*static_cast<const Take*>(to))(index, distance_squared, count);
      },
      const_cast<void*>(static_cast<const void*>(&take)));
}

}  // namespace kaustik::photon
