#pragma once
// The photons from which guided emission learns.

#include <functional>

#include "accel/bvh.h"
#include "photon/emission/emission_guide.h"
#include "photon/record/photon.h"

namespace kaustik::photon {

struct GuideSettings {
  uint64_t seed = 0;
  // Of the render: a thirteenth of them is emitted to learn from; more where few serve, until they have
  // traced half as many rays.
  uint64_t photons = 0;
  int max_bounces = 16;
  EmissionMode emission = EmissionMode::kCosine;
  PhotonKind kind = PhotonKind::kCaustic;  // that is to be left
  // How much a photon matters where it was left; zero: it does not serve. Unset: all matter alike.
  // Thread-safe, and a function of the photon alone.
  std::function<float(const Photon&)> importance{};
  // Where so many of the uniform photons serve, nothing is guided.
  double enough = 2;
};

struct LearnedGuide {
  EmissionGuide guide;             // empty where guiding would not help much
  uint64_t emitted = 0, hits = 0;  // photons learned from, and how many of them served
};

// Emits photons in rounds, each but the first guided by what all before have found, and learns where those
// start that leave photons of the kind where they matter. A function of scene and settings alone, whatever
// the number of threads.
LearnedGuide learn_guide(const Scene& scene, const accel::Bvh& bvh, const GuideSettings& settings);

}  // namespace kaustik::photon
