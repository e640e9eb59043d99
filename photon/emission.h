#pragma once
// The start of photon i of N: lamp chosen by power, then position and direction from the lamp.
//
// flux_i = Le |cos| / (N p(lamp) p(position) p(direction)) (Jensen 2001, section 5.1; Pharr et al. 2023,
// section 12.1), so that the sum over i of flux_i estimates the lamps' power whatever the probabilities are.

#include <cstdint>
#include <optional>

#include "core/sampling/sampler.h"
#include "core/scene/scene.h"

namespace kaustik::photon {

// Ray (world space, unit direction, origin off the lamp) and flux in watts, already divided by `total` and by
// the probability of the lamp: the sum over i of flux tends to the lamps' power. Nothing when there is no
// lamp, or when the lamp emits nothing in the sampled direction. Draws the sampler's first five dimensions:
// position, direction, and then, only when there are several lamps, the lamp. Thread-safe; unbiased.
std::optional<EmissionSample> emit_photon(const Scene& scene, Sampler& sampler, uint64_t total,
                                          EmissionMode mode);

}  // namespace kaustik::photon
