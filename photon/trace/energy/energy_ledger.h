#pragma once
// Balance of a shoot's energy: every emitted watt is absorbed by a surface or a medium, escapes from the
// scene, ends with a path that is not followed further, is lost (or gained) by Russian roulette, or is
// dropped as invalid.
//
// Fluxes are counted in whole multiples of a unit, so that the entries add up exactly and in any order: a
// nonzero unaccounted() means that a photon was lost or booked twice. Rounding changes each entry by at most
// half a unit for each path segment in it; a unit is at most 2^-16 of a photon's mean flux.

#include <cmath>
#include <cstdint>

#include "core/scene/scene.h"

namespace kaustik::photon {

// Entries are signed multiples of 2^unit_exponent watts, summed over the three channels. The straight rays
// that leave shadow photons carry no energy.
struct EnergyLedger {
  int64_t emitted = 0;     // emitted by the lights
  int64_t absorbed = 0;    // absorbed by BSDFs; negative only through the shading-normal correction
  int64_t in_media = 0;    // absorbed by media
  int64_t escaped = 0;     // carried out of the scene by rays that met nothing
  int64_t terminated = 0;  // path reached max_bounces, or no requested photon kind needs its rest
  int64_t roulette = 0;    // lost minus gained: zero on average
  int64_t invalid = 0;     // photon scattered to NaN, infinite or negative flux
  int unit_exponent = 0;

  int64_t unaccounted() const {
    return emitted - absorbed - in_media - escaped - terminated - roulette - invalid;
  }
  double watts(int64_t units) const { return std::ldexp(static_cast<double>(units), unit_exponent); }
  // Both ledgers must have the same unit, unless this one is still empty.
  EnergyLedger& operator+=(const EnergyLedger& o);
  bool operator==(const EnergyLedger&) const = default;
};

// Exponent of the ledger's unit when `photons` photons share scene.light_power: 2^16 units are the largest
// power of two that does not exceed the mean flux of a photon. Scaling the scene by 2^k scales the unit
// exactly.
int energy_unit_exponent(const Scene& scene, uint64_t photons);

// A photon's energy is capped at this many units.
inline constexpr float kMostEnergy = 0x1p24f;

// Flux (which must be valid) in units, rounded to the nearest integer.
inline int32_t energy_of(const Rgb& flux, float units_per_watt) {
  return static_cast<int32_t>(
      std::nearbyint(std::min((flux.x + flux.y + flux.z) * units_per_watt, kMostEnergy)));
}

}  // namespace kaustik::photon
