#pragma once
// The energy ledger's sums over many photons at once in SIMD lanes.

#include "photon/trace/energy_ledger.h"
#include "photon/trace/walker_rows.h"

namespace kaustik::photon {

// Energies of the first `count` fluxes: energy_of() bit for bit. Whole vectors are written. Thread-safe.
void to_energy_lanes(const float (&flux)[3][VertexLanes::kLanes], size_t count, float units_per_watt,
                     int32_t (&energy)[VertexLanes::kLanes]);

// Adds the segments that ended: energy arrives with walkers.energy. Where nothing was met it escapes; where
// `scatters` is one, lanes.scattered_energy and lanes.next_energy say what is left before and after Russian
// roulette; elsewhere it is terminated. Leaves what goes on in walkers.energy. All lanes are read; those not
// in use must hold no energy and not scatter. Thread-safe.
void book_lanes(const VertexLanes& lanes, const uint8_t (&scatters)[VertexLanes::kLanes],
                WalkerLanes& walkers, EnergyLedger& ledger);

}  // namespace kaustik::photon
