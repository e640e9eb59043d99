#pragma once
// What a search for photons asks and counts.

#include <cstdint>

#include "core/math/vec.h"
#include "photon/record/packing.h"
#include "photon/record/photon_columns.h"

namespace kaustik::photon {

// Photons count within radius of p (d <= radius, metres), on the same surface group (modulo 2^16) and with a
// normal near n (kNormalCosine), which is unit and lies on the viewer's side.
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

}  // namespace kaustik::photon
