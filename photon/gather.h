#pragma once
// What a gather asks and counts, and the SIMD loops over contiguous photons. Which lanes count is decided
// without fused operations, so every instruction set accepts the same photons; only the order of the sum
// depends on it.

#include <cstdint>
#include <limits>
#include <span>

#include "core/math/vec.h"
#include "photon/kernel.h"

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
};

// Exact counts, merged by integer sums.
struct GatherCounters {
  uint64_t queries = 0;
  uint64_t candidates = 0;  // photons whose distance was computed
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
  const uint32_t* power = nullptr;  // RGB9E5 in flux units, or null when the f32 columns are there
  const float* power_f32[3] = {};   // flux units
};
inline constexpr uint64_t kGatherPadding = 64;

// sum and accepted of one batch of ranges.
struct GatherSum {
  glm::dvec3 flux{0};  // flux units times (1 - slope s), see KernelTerms: multiply by scale and flux_unit
  uint64_t accepted = 0;
};
GatherSum gather_ranges(const PhotonColumns& columns, std::span<const PhotonRange> ranges,
                        const GatherQuery& query, KernelType kernel, float slope);

// Photons of one range of at most kSelectBlock that count: writes index (relative to range.begin) and squared
// distance, returns how many. Both outputs hold kSelectBlock + kGatherPadding elements. radius_squared
// replaces query.radius.
inline constexpr uint64_t kSelectBlock = 256;
size_t select_range(const PhotonColumns& columns, PhotonRange range, const GatherQuery& query,
                    float radius_squared, uint32_t* index, float* distance_squared);

}  // namespace kaustik::photon
