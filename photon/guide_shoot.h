#pragma once
// The photons from which guided emission learns.

#include "accel/bvh.h"
#include "photon/emission_guide.h"

namespace kaustik::photon {

struct GuideSettings {
  uint64_t seed = 0;
  uint64_t photons =
      0;  // of the render: an eighth of them is emitted to learn from, or up to .3 where few serve
  int max_bounces = 16;
  EmissionMode emission = EmissionMode::kCosine;
};

struct LearnedGuide {
  EmissionGuide guide;             // empty where guiding would not help much
  uint64_t emitted = 0, hits = 0;  // photons learned from, and how many of them left a caustic photon
};

// Emits photons in rounds, each but the first guided by what all before have found, and learns where those
// start that leave caustic photons. A function of scene and settings alone, whatever the number of threads.
LearnedGuide learn_guide(const Scene& scene, const accel::Bvh& bvh, const GuideSettings& settings);

}  // namespace kaustik::photon
