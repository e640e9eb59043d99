#pragma once
// The interface of a structure that finds the photons near a point, so that it can be measured and tested
// with the others.

#include <concepts>
#include <string_view>

#include "photon/gather/gather_query.h"
#include "photon/record/photon_record.h"

namespace kaustik::benchmarks {

// Which photons count is the same for all: by distance, surface group and normal, as photon::GatherQuery
// says. `within` is ignored. const members may be called from any thread.
//   kName                 for tables
//   build(photons, r)     photons in the order of the shoot; r: the largest radius of the queries, metres. A
//                         grid is made for it, a tree need not read it. Not for radii below 1e-19, whose
//                         squares vanish.
//   flux_density(q, c)    sum of flux / (pi q.radius^2) over the photons that count, W/m^2; zero unless the
//                         radius is positive and finite. At most 1024 terms are added in float, then in
//                         double. Counters are added to.
//   for_each(q, c, fn)    fn(flux) for each photon that counts, watts, in any order
//   memory_bytes()        all memory that is in use while queries are answered
template <class T>
concept PhotonIndex = std::move_constructible<T> &&
    requires(const T& index, photon::PhotonBuffer photons, float radius, const photon::GatherQuery& query,
             photon::GatherCounters& counters, void (*fn)(const Rgb&)) {
  { T::kName } -> std::convertible_to<std::string_view>;
  { T::build(std::move(photons), radius) } -> std::same_as<T>;
  { index.flux_density(query, counters) } -> std::same_as<Rgb>;
  index.for_each(query, counters, fn);
  { index.memory_bytes() } -> std::same_as<uint64_t>;
};

// An index that also finds the k-th nearest photon.
//   nearest_radius(q, k, c)  photon::nearest_radius(): metres
template <class T>
concept NearestIndex = PhotonIndex<T> &&
    requires(const T& index, const photon::GatherQuery& query, photon::GatherCounters& counters) {
  { index.nearest_radius(query, 1u, counters) } -> std::same_as<float>;
};

}  // namespace kaustik::benchmarks
