// Emission of one photon: the scalar code that emission_lanes.cpp repeats in lanes.

#include "photon/emission/emission.h"

namespace kaustik::photon {

std::optional<EmissionSample> emit_photon(const Scene& scene, const EmissionNumbers& u, uint64_t total,
                                          EmissionMode mode, std::optional<uint32_t> only) {
  if (scene.light_power.empty() || !(scene.light_power.total() > 0)) return std::nullopt;
  const auto [light, p_light] = light_of_photon(scene, u.light, only);
  auto start = std::visit([&](const auto& l) { return l.sample_Le(u.position, u.direction, mode); },
                          scene.lights[light]);
  if (start) start->flux *= static_cast<float>(1 / (double{p_light} * static_cast<double>(total)));
  return start;
}

}  // namespace kaustik::photon
