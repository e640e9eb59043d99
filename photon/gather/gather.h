#pragma once
// Gathers over a photon map. Which photons count is decided without fused operations, so it is the same on
// every instruction set; only the order of the sum depends on it. All functions are thread-safe.

#include <limits>

#include "photon/gather/gather_query.h"
#include "photon/gather/kernel.h"
#include "photon/gather/photon_discs.h"
#include "photon/map/photon_map.h"

namespace kaustik::photon {

// Radii in metres of the discs of the photons that count in a gather; 0 if none does.
struct DiscRadii {
  float mean = 0;  // of the disc whose 1/r^2 is the mean of theirs
  float widest = 0;
};

// Returns the sum of flux K(d) over the photons that count, in W/m^2. The order of the sum is fixed. With
// query.discs the kernel of each photon is that of its own disc. radii: may be null; without discs both are
// the query's.
Rgb gather_flux(const PhotonMap& map, const GatherQuery& query, const KernelSpec& kernel,
                GatherCounters& counters, DiscRadii* radii = nullptr);

// Calls fn(const Photon&, float distance_squared) for each photon that counts, in Morton order. With
// query.discs both flux and distance are stretched, so that the flux times the kernel of the query's radius
// at that distance is what the photon adds.
template <class Fn>
void for_each_photon(const PhotonMap& map, const GatherQuery& query, Fn&& fn, GatherCounters& counters);

// Calls fn(uint32_t index, float distance_squared) for each photon that counts, in ascending order. With
// query.discs the distance is stretched.
template <class Fn>
void for_each_index(const PhotonMap& map, const GatherQuery& query, Fn&& fn, GatherCounters& counters);

namespace detail {

// Sums of the SIMD loops.
struct GatherSum {
  glm::dvec3 flux{
      0};  // in flux units times the kernel's weight: multiply by KernelTerms::scale and flux_unit
  uint64_t accepted = 0, candidates = 0;
  // Of the photons' discs: the sum and the smallest stretch of those accepted.
  double stretch = 0;
  float least_stretch = std::numeric_limits<float>::infinity();
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
void for_each_index(const PhotonMap& map, const GatherQuery& query, Fn&& fn, GatherCounters& counters) {
  ++counters.queries;
  const auto take = [&](const uint32_t* index, const float* distance_squared, size_t count) {
    for (size_t i = 0; i < count; ++i) fn(index[i], distance_squared[i]);
  };
  using Take = decltype(take);
  detail::select_photons(
      map, query, counters,
      [](void* to, const uint32_t* index, const float* distance_squared, size_t count) {
        (*static_cast<const Take*>(to))(index, distance_squared, count);
      },
      const_cast<void*>(static_cast<const void*>(&take)));
}

template <class Fn>
void for_each_photon(const PhotonMap& map, const GatherQuery& query, Fn&& fn, GatherCounters& counters) {
  for_each_index(
      map, query,
      [&](uint32_t i, float distance_squared) {
        Photon photon = map.photon(i);
        if (query.discs) photon.flux *= query.discs->stretch()[i];
        fn(photon, distance_squared);
      },
      counters);
}

}  // namespace kaustik::photon
