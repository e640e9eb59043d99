#pragma once
// The start of photon i of N: light chosen by power, or given, then position and direction from the light.
//
// flux_i = Le |cos| / (N p(light) p(position) p(direction)) (Jensen 2001, section 5.1; Pharr et al. 2023,
// section 12.1), so that the sum over i of flux_i estimates the lights' power whatever the probabilities are.

#include <cstdint>
#include <optional>

#include "core/sampling/sampler.h"
#include "core/scene/scene.h"

namespace kaustik::photon {

// The random numbers of one start, in [0, 1).
struct EmissionNumbers {
  Point2 position, direction;
  float light = 0;  // needed when there are several lights
};

// The sampler's first five dimensions; the fifth is drawn only when it is needed.
inline EmissionNumbers emission_numbers(const Scene& scene, Sampler& sampler) {
  EmissionNumbers u{sampler.next_2d(), sampler.next_2d()};
  if (scene.lights.size() > 1) u.light = sampler.next_1d();
  return u;
}

// Ray (world space, unit direction, origin off the light) and flux in watts, already divided by `total` and
// by the probability of the light: the sum over i of flux tends to the lights' power (of what comes from the
// sky through a portal, before what stands outside takes its part: EmissionSample::from_sky). Nothing when
// there is no light, or when the light emits nothing in the sampled direction. only: the index of the one
// light that emits; then the sum tends to its power. Thread-safe; unbiased.
std::optional<EmissionSample> emit_photon(const Scene& scene, const EmissionNumbers& u, uint64_t total,
                                          EmissionMode mode, std::optional<uint32_t> only = {});

}  // namespace kaustik::photon
