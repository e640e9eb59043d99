#pragma once
// Where the flux of a shoot goes: every watt that sets out is absorbed by a surface, escapes from the scene,
// ends with a path that is not followed further, is lost (or gained) by Russian roulette, or was dropped.
//
// Fluxes are counted in whole multiples of a unit, so that the entries add up exactly and in any order: what
// is unaccounted for is zero, or a photon went missing. Rounding moves each entry by half a unit for each
// path segment in it; a unit is at most 2^-16 of a photon's mean flux.

#include <cmath>
#include <cstdint>

#include "core/scene/scene.h"

namespace kaustik::photon {

// Signed multiples of 2^unit_exponent watts, summed over the three channels. Straight rays behind the first
// surface carry no energy of their own.
struct EnergyLedger {
  int64_t emitted = 0;     // set out from the lights
  int64_t absorbed = 0;    // what BSDFs kept; below zero only by the correction for shading normals
  int64_t escaped = 0;     // with rays that met nothing
  int64_t terminated = 0;  // with paths as long as max_bounces, or whose rest no kind asked for
  int64_t roulette = 0;    // lost minus gained: zero on the mean
  int64_t invalid = 0;     // with photons that scattered to NaN, infinite or negative flux
  int unit_exponent = 0;

  int64_t unaccounted() const { return emitted - absorbed - escaped - terminated - roulette - invalid; }
  double watts(int64_t units) const { return std::ldexp(static_cast<double>(units), unit_exponent); }
  // Of the same unit, or of none yet.
  EnergyLedger& operator+=(const EnergyLedger& o);
  bool operator==(const EnergyLedger&) const = default;
};

// The unit's exponent for so many photons of these lights: 2^16 units are the power of two below the mean
// flux of a photon by the lights' power as light_power has it. Scaling a scene by 2^k scales the unit
// exactly.
int energy_unit_exponent(const Scene& scene, uint64_t photons);

// A photon holds at most so many units; more is counted as this.
inline constexpr float kMostEnergy = 0x1p24f;

// Rounded to whole units. flux: valid.
inline int32_t energy_of(const Rgb& flux, float units_per_watt) {
  return static_cast<int32_t>(
      std::nearbyint(std::min((flux.x + flux.y + flux.z) * units_per_watt, kMostEnergy)));
}

}  // namespace kaustik::photon
