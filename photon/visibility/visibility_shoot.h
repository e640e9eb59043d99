#pragma once
// The photons that predict visibility.

#include "accel/bvh.h"
#include "photon/visibility/visibility_tree.h"

namespace kaustik::photon {

struct VisibilitySettings {
  uint64_t seed = 0;
  uint64_t photons = 0;  // emitted by all lights together
  EmissionMode emission = EmissionMode::kCosine;
};

// Lets each light but skies emit its share of the photons, by power, and counts where they go straight on:
// nothing is scattered and nothing stored. Of more than VisibilityTree::kMostLights lights the others are
// left out: nothing is predicted of them. The result is a function of scene and settings alone, whatever the
// number of threads.
VisibilityTree predict_visibility(const Scene& scene, const accel::Bvh& bvh,
                                  const VisibilitySettings& settings);

}  // namespace kaustik::photon
