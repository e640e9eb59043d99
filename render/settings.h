#pragma once
// Everything a render can be told. The command line and the scene file's Integrator "photonmap" line fill the
// same struct.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/light/light_types.h"
#include "photon/gather/kernel.h"

namespace kaustik::render {

enum class Method { kAuto, kRaytrace, kMc, kHybrid, kPhoton };
enum class DirectEstimator { kShadowRays, kPhotons, kLecture, kPredicted, kSigned };
enum class CausticEstimator { kPhotons, kPaths, kOff };
enum class IndirectEstimator { kPaths, kPhotons, kOff };
using Kernel = photon::KernelType;
enum class Lookup { kExact, kLeaf };
enum class Guide { kOff, kOn };  // of the photons that make caustics

struct CropWindow {
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0;  // pixels, half open; empty = whole image
  bool empty() const { return x1 <= x0 || y1 <= y0; }
};

struct RenderSettings {
  Method method = Method::kAuto;
  // Unset: what the method chooses.
  std::optional<DirectEstimator> direct;
  std::optional<CausticEstimator> caustics;
  std::optional<IndirectEstimator> indirect;

  uint64_t photons = 1'000'000;  // emitted, rounded up to a multiple of the passes, as spp is
  std::optional<float> radius;   // gather radius r0 in metres; unset = auto
  float radius_factor = 1;       // above 0: of auto's radii, where radius is unset
  // In (0, 1]: how slowly the radius shrinks from pass to pass; 1, also when unset: not at all.
  std::optional<float> alpha;
  uint32_t nearest = 0;  // K > 0: radius shrinks to the K-th nearest photon
  Kernel kernel = Kernel::kConstant;
  float cone_k = 1.1f;         // k >= 1 of the cone filter
  uint32_t min_photons = 8;    // M0 of the lecture's test
  uint32_t node_photons = 64;  // N0: octree nodes with at most so many photons are leaves
  Lookup lookup = Lookup::kExact;
  EmissionMode emission = EmissionMode::kCosine;
  Guide guide = Guide::kOn;
  int max_bounces = 16;
  int spp = 16;  // of each pixel
  // Of the work of those, at most so much for further ones; 0: none. 0.75 measured (docs/performance.md).
  float adaptive = 0.75f;
  uint64_t seed = 0;
  int threads = 0;            // 0 = all the process may use
  int width = 0, height = 0;  // 0 = as the scene says
  CropWindow crop;
  // Measure the kernels' bias, once a pixel and pass; unset = no.
  std::optional<bool> estimate_bias;
  std::vector<std::string> aov;  // layers to write besides the image; empty = none, "all" = all
  // That photons and spp are shared out over; 0 = as many as it takes for the photons of one to fit into
  // photon_memory.
  uint64_t passes = 0;
  // Bytes that the photons of a pass may take while they are shot and their maps built.
  uint64_t photon_memory = std::numeric_limits<uint64_t>::max();
};

// Whether direct light comes from samples of the lights: then it is shared with paths that leave anyway.
inline bool samples_lights(DirectEstimator direct) {
  return direct == DirectEstimator::kShadowRays || direct == DirectEstimator::kPredicted;
}

// The estimators that a render uses, settled from method, overrides and the scene's needs.
struct EstimatorPlan {
  DirectEstimator direct = DirectEstimator::kShadowRays;
  CausticEstimator caustics = CausticEstimator::kOff;
  IndirectEstimator indirect = IndirectEstimator::kOff;
  std::vector<std::string> notes;  // what was chosen and left out, and why: one sentence each
};

}  // namespace kaustik::render
