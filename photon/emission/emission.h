#pragma once
// Emission of photon i of N: a light is chosen by power (or given), then a position and direction on it.
//
// flux_i = Le |cos| / (N p(light) p(position) p(direction)) (Jensen 2001, section 5.1; Pharr et al. 2023,
// section 12.1), so that the sum of flux_i over i estimates the lights' power, whatever the probabilities
// are.

#include <cstdint>
#include <optional>

#include "core/sampling/sampler.h"
#include "core/scene/scene.h"

namespace kaustik::photon {

// Random numbers of one emission, in [0, 1).
struct EmissionNumbers {
  Point2 position, direction;
  float light = 0;  // used only if there are several lights
};

// The sampler's first five dimensions; the fifth is drawn only if there are several lights.
inline EmissionNumbers emission_numbers(const Scene& scene, Sampler& sampler) {
  EmissionNumbers u{sampler.next_2d(), sampler.next_2d()};
  if (scene.lights.size() > 1) u.light = sampler.next_1d();
  return u;
}

// The light that a photon chooses, and the probability of that. u_light: EmissionNumbers::light; only: as for
// emit_photon().
struct LightOfPhoton {
  uint32_t light = 0;
  float p = 1;
};
inline LightOfPhoton light_of_photon(const Scene& scene, float u_light, std::optional<uint32_t> only = {}) {
  if (only || scene.lights.size() == 1) return {only.value_or(0), 1};
  const DiscreteDistribution::Sample chosen = scene.light_power.sample(u_light);
  return {chosen.index, chosen.pdf};
}

// Ray (world space, unit direction, origin moved off the light) and flux in watts, already divided by `total`
// and by the light's probability: the sum of flux over i tends to the lights' power. For light from the sky
// through a portal it does so before occlusion outside the portal is taken into account: see
// EmissionSample::from_sky. Nothing is returned when there is no light, or when the light emits nothing in
// the sampled direction. only: index of the one light that emits; the sum then tends to its power. Unbiased.
// Thread-safe.
std::optional<EmissionSample> emit_photon(const Scene& scene, const EmissionNumbers& u, uint64_t total,
                                          EmissionMode mode, std::optional<uint32_t> only = {});

}  // namespace kaustik::photon
