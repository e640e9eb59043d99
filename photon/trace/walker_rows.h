#pragma once
// Photons on their way as rows of memory, and back into columns, many at once in SIMD lanes.

#include "photon/trace/vertex_lanes.h"
#include "photon/trace/walk_state.h"

namespace kaustik::photon {

// What photons have besides ray and flux, by columns.
struct WalkerLanes {
  static constexpr size_t kLanes = VertexLanes::kLanes;
  alignas(64) uint32_t reversed_index[kLanes];
  WalkState state[kLanes];
  int32_t energy[kLanes];  // of the flux, in units of the ledger; zero for straight rays
};

// Rows of twelve words in three parts: (o, d.x), (d.yz, flux.rg), (flux.b, index, state, energy).
struct WalkerRows {
  static constexpr size_t kLanes = VertexLanes::kLanes;
  alignas(64) uint32_t part[3][kLanes][4];
  uint32_t octant[kLanes];  // of d: bit c is the sign of component c
};

// Of the first `count` lanes: whole vectors are written. Thread-safe.
void to_rows(const accel::RayLanes& rays, const float (&flux)[3][WalkerLanes::kLanes],
             const WalkerLanes& walkers, size_t count, WalkerRows* rows);

// The inverse; part[i] points to part i of the first row. Whole vectors are read. Thread-safe.
void from_rows(const uint32_t* const (&part)[3], size_t count, accel::RayLanes* rays,
               float (&flux)[3][WalkerLanes::kLanes], WalkerLanes* walkers);

}  // namespace kaustik::photon
