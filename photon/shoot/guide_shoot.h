#pragma once
// Learning rounds of guided emission: traces photons and learns an EmissionGuide from the useful ones.

#include <functional>

#include "accel/bvh.h"
#include "photon/emission/emission_guide.h"
#include "photon/record/photon.h"
#include "photon/trace/trace_settings.h"

namespace kaustik::photon {

struct GuideSettings {
  uint64_t seed = 0;
  // Photons of the render. A thirteenth of them is emitted for learning; where few are useful, more, until
  // half as many rays as this have been traced.
  uint64_t photons = 0;
  int max_bounces = 16;
  EmissionMode emission = EmissionMode::kCosine;
  PhotonKind kind = PhotonKind::kCaustic;  // the kind of photon that is to be left, on surfaces and in media
  // How much a photon matters where it was left; zero: it is useless. Unset: all matter equally. Must be
  // thread-safe and a function of the photon alone. The kind tells whether it is in a medium.
  std::function<float(PhotonKind, const Photon&)> importance{};
  // If more than this fraction of the uniform photons is useful, nothing is guided.
  double enough = 2;
  bool under_glossy = false;  // as in TraceSettings, as are these
  const SourceSplit* split = nullptr;
  bool split_caustics = false, of_paths = false;
};

struct LearnedGuide {
  EmissionGuide guide;             // empty where guiding would not help much
  uint64_t emitted = 0, hits = 0;  // photons emitted for learning, and useful starts among them
};

// Emits photons in rounds, each but the first guided by what all earlier rounds found, and learns which
// starts leave photons of settings.kind where they matter. A function of scene and settings alone, whatever
// the number of threads.
LearnedGuide learn_guide(const Scene& scene, const accel::Bvh& bvh, const GuideSettings& settings);

}  // namespace kaustik::photon
