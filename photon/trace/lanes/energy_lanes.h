#pragma once
// Conversion of photon fluxes to ledger units and the booking of energy, for a group of photons in SIMD
// lanes.

#include "photon/trace/energy/energy_ledger.h"
#include "photon/trace/lanes/walker_rows.h"

namespace kaustik::photon {

// Converts the first `count` fluxes to energies, bit for bit as energy_of() does. Writes whole vectors, so up
// to a vector's width beyond `count`. Thread-safe.
void to_energy_lanes(const float (&flux)[3][kPhotonLanes], size_t count, float units_per_watt,
                     int32_t (&energy)[kPhotonLanes]);

// Books the path segments that have just ended; each arrives with walkers.energy. A segment that met nothing
// escapes. Where `scatters` is one, lanes.scattered_energy and lanes.next_energy hold what remains before and
// after Russian roulette. All others are terminated. Afterwards walkers.energy is the energy that travels on.
// All lanes are read; lanes that are not in use must have zero energy and `scatters` zero. Thread-safe.
void book_lanes(const VertexLanes& lanes, const uint8_t (&scatters)[kPhotonLanes], WalkerLanes& walkers,
                EnergyLedger& ledger);

}  // namespace kaustik::photon
