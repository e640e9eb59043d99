#pragma once
// Photons on their way as rows in memory, and their transposition from and to the columns of SIMD lanes.

#include "photon/trace/lanes/vertex_lanes.h"
#include "photon/trace/lanes/walk_state.h"

namespace kaustik::photon {

// What a photon carries besides ray and flux, as columns.
struct WalkerLanes {
  static constexpr size_t kLanes = kPhotonLanes;
  alignas(64) uint32_t reversed_index[kLanes];
  WalkState state[kLanes];
  int32_t energy[kLanes];  // of the flux, in ledger units; zero for straight rays
};

// Rows of twelve words in three parts: (o, d.x), (d.yz, flux.rg), (flux.b, index, state, energy).
struct WalkerRows {
  static constexpr size_t kLanes = kPhotonLanes;
  alignas(64) uint32_t part[3][kLanes][4];
  uint32_t octant[kLanes];  // of d: bit c is set where component c is negative
};

// Transposes the first `count` lanes to rows. Writes whole vectors. Thread-safe.
void to_rows(const accel::RayLanes& rays, const float (&flux)[3][WalkerLanes::kLanes],
             const WalkerLanes& walkers, size_t count, WalkerRows* rows);

// Transposes `count` rows to lanes; part[i] points to part i of the first row. Reads whole vectors.
// Thread-safe.
void from_rows(const uint32_t* const (&part)[3], size_t count, accel::RayLanes* rays,
               float (&flux)[3][WalkerLanes::kLanes], WalkerLanes* walkers);

}  // namespace kaustik::photon
