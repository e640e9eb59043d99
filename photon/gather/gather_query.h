#pragma once
// The query of a photon search, and the counts that searches keep.

#include <cstdint>

#include "core/math/vec.h"
#include "photon/record/packing.h"
#include "photon/record/photon_columns.h"

namespace kaustik::photon {

class PhotonDiscs;

// A photon counts if it is within radius of p (d <= radius, metres), on the same surface group (modulo 2^16),
// and its normal is near n (kNormalCosine). n is a unit vector on the viewer's side. With discs, which must
// be those of the map, the distance d of each photon is stretched first, so that a radius of discs->largest()
// asks for the photons whose own discs cover p, and half of it for those whose discs of half the size do.
struct GatherQuery {
  Point3 p{0};
  Normal3 n{0, 0, 1};
  uint32_t surface_group = 0;
  float radius = 0;
  PhotonRange within = kAllPhotons;    // restricts the search, for instance to a cell in the leaf lookup
  const PhotonDiscs* discs = nullptr;  // the photons' own discs; null: all photons reach equally far

  // Negative if radius is negative or NaN, so that no photon counts.
  float radius_squared() const { return radius >= 0 ? radius * radius : -1.0f; }
};

// Exact counts; merging them adds integers.
struct GatherCounters {
  uint64_t queries = 0;
  uint64_t candidates = 0;  // photons in the blocks that the searches read
  uint64_t accepted = 0;    // photons that counted
  GatherCounters& operator+=(const GatherCounters& o) {
    queries += o.queries;
    candidates += o.candidates;
    accepted += o.accepted;
    return *this;
  }
};

}  // namespace kaustik::photon
