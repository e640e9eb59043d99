#pragma once
// What a search for photons asks and counts, and its SIMD loops. Which photons count is decided without fused
// operations, so every instruction set accepts the same ones; only the order of the sum depends on it.

#include <cstdint>
#include <limits>

#include "core/math/vec.h"
#include "photon/gather/kernel.h"

namespace kaustik::photon {

// Photons [begin, end) in Morton order.
struct PhotonRange {
  uint64_t begin = 0, end = 0;
  uint64_t size() const { return end - begin; }
  bool empty() const { return begin >= end; }
};
inline constexpr PhotonRange kAllPhotons{0, std::numeric_limits<uint64_t>::max()};

// A photon counts when its normal and the query's make a cosine above this (60 degrees): curved surfaces keep
// their photons, the other side of a sheet and the far wall of a corner do not count.
inline constexpr float kNormalCosine = 0.5f;

// Photons count within radius of p (d <= radius, metres), on the same surface group (modulo 2^16) and with a
// normal near n, which is unit and lies on the viewer's side.
struct GatherQuery {
  Point3 p{0};
  Normal3 n{0, 0, 1};
  uint32_t surface_group = 0;
  float radius = 0;
  PhotonRange within = kAllPhotons;  // e.g. the range of a cell, for the leaf lookup

  // Below zero, where nothing is in reach, unless radius >= 0.
  float radius_squared() const { return radius >= 0 ? radius * radius : -1.0f; }
};

// Exact counts, merged by integer sums.
struct GatherCounters {
  uint64_t queries = 0;
  uint64_t candidates = 0;  // photons of the blocks that were looked through for the query
  uint64_t accepted = 0;    // photons that counted
  GatherCounters& operator+=(const GatherCounters& o) {
    queries += o.queries;
    candidates += o.candidates;
    accepted += o.accepted;
    return *this;
  }
};

// The columns of a photon map. Readable for kGatherPadding elements beyond the last photon.
struct PhotonColumns {
  const float *x = nullptr, *y = nullptr, *z = nullptr;
  const uint32_t* direction = nullptr;
  const uint32_t* surface = nullptr;
  const uint32_t* power = nullptr;  // RGB9E5 in flux units
};
inline constexpr uint64_t kGatherPadding = 64;

// The columns with what finds those near a point.
class BoxTree;
class Octree;
struct IndexedPhotons {
  PhotonColumns columns;  // beyond the last photon x is NaN
  const Octree* octree = nullptr;
  const BoxTree* tree = nullptr;
  uint64_t size = 0;  // photons
};

struct GatherSum {
  glm::dvec3 flux{0};  // flux units times (1 - slope s), see KernelTerms: multiply by scale and flux_unit
  uint64_t accepted = 0, candidates = 0;
};

// Over the photons that count. The order of the sum depends on the instruction set, and on nothing else.
GatherSum gather_photons(const IndexedPhotons& photons, const GatherQuery& query, KernelType kernel,
                         float slope);

// Calls take(to, ...) with the photons that count, ascending, and their squared distances. Adds to candidates
// and accepted.
using TakePhotons = void (*)(void* to, const uint32_t* index, const float* distance_squared, size_t count);
void select_photons(const IndexedPhotons& photons, const GatherQuery& query, GatherCounters& counters,
                    TakePhotons take, void* to);

}  // namespace kaustik::photon
