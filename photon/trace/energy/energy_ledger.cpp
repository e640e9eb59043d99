// Sums of ledgers, and the choice of the unit.

#include "photon/trace/energy/energy_ledger.h"

#include <algorithm>

namespace kaustik::photon {

EnergyLedger& EnergyLedger::operator+=(const EnergyLedger& o) {
  if (emitted == 0) unit_exponent = o.unit_exponent;
  emitted += o.emitted;
  absorbed += o.absorbed;
  in_media += o.in_media;
  escaped += o.escaped;
  terminated += o.terminated;
  roulette += o.roulette;
  invalid += o.invalid;
  return *this;
}

int energy_unit_exponent(const Scene& scene, uint64_t photons) {
  const double mean = scene.light_power.total() / static_cast<double>(std::max<uint64_t>(1, photons));
  constexpr int kFraction = 16;
  if (!(mean > 0) || !std::isfinite(mean)) return -kFraction;
  // The limits keep the unit and its inverse within the range of float.
  return std::clamp(std::ilogb(mean), -100, 100) - kFraction;
}

}  // namespace kaustik::photon
