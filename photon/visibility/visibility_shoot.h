#pragma once
// Traces the photons from which visibility is predicted.

#include "accel/bvh.h"
#include "photon/visibility/visibility_tree.h"

namespace kaustik::photon {

struct VisibilitySettings {
  uint64_t seed = 0;
  uint64_t photons = 0;  // emitted by all lights together
  EmissionMode emission = EmissionMode::kCosine;
};

// Each finite light emits its share of the photons, by power; infinite lights emit none. Each photon flies
// straight on, and records whether the light is visible where it passes a surface: nothing is scattered and
// nothing stored. Lights beyond the first VisibilityTree::kMostLights are left out, so nothing is predicted
// for them. The result is a function of scene and settings alone, whatever the number of threads.
VisibilityTree predict_visibility(const Scene& scene, const accel::Bvh& bvh,
                                  const VisibilitySettings& settings);

}  // namespace kaustik::photon
