#pragma once
// All settings of a render, filled by the command line and by the scene file's Integrator "photonmap" line.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/light/interface/light_types.h"
#include "photon/gather/kernel.h"

namespace kaustik::render {

enum class Method { kAuto, kRaytrace, kMc, kHybrid, kPhoton };
enum class DirectEstimator { kShadowRays, kPhotons, kLecture, kPredicted, kSigned };
enum class CausticEstimator { kPhotons, kPaths, kSplit, kOff };
enum class IndirectEstimator { kPaths, kPhotons, kSplit, kOff };
using Kernel = photon::KernelType;
enum class Lookup { kExact, kLeaf };
// Whether caustic and indirect photons are as many as few of them tell is worth their time, and samples as
// many as the noise of paths asks for.
enum class Balance { kOff, kOn };
enum class Guide { kOff, kOn };  // whether caustic and indirect photons are guided
// The cameras for which photons are guided and radii chosen: the one of the render, or any in the scene.
enum class ForCamera { kThis, kAll };

struct CropWindow {
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0;  // pixels, half open; empty = whole image
  bool empty() const { return x1 <= x0 || y1 <= y0; }
};

struct RenderSettings {
  Method method = Method::kAuto;
  // Unset: chosen by the method.
  std::optional<DirectEstimator> direct;
  std::optional<CausticEstimator> caustics;
  std::optional<IndirectEstimator> indirect;

  uint64_t photons = 1'000'000;  // emitted in all passes; rounded up to a multiple of the passes, as spp is
  Balance balance = Balance::kOff;  // kOn: `photons` is the scale of the number of each kind
  std::optional<float> radius;      // gather radius r0 in metres; unset = auto
  float radius_factor = 1;          // > 0; multiplies the automatic radii where radius is unset
  // In (0, 1]: how slowly the radius shrinks from pass to pass (Knaus and Zwicker 2011); 1 or unset: not at
  // all.
  std::optional<float> alpha;
  uint32_t nearest = 0;  // K > 0: radius shrinks to the K-th nearest photon
  Kernel kernel = Kernel::kConstant;
  float cone_k = 1.1f;         // k >= 1 of the cone filter
  uint32_t min_photons = 8;    // M0 of the lecture's test: a cell with more photons may answer
  uint32_t node_photons = 64;  // N0: octree nodes with at most this many photons are leaves
  Lookup lookup = Lookup::kExact;
  EmissionMode emission = EmissionMode::kCosine;
  Guide guide = Guide::kOn;
  ForCamera for_camera = ForCamera::kThis;
  int max_bounces = 16;
  // Whether paths may end in what few photons tell of the light of surfaces (render/maps/path_ends.h); unset:
  // no.
  std::optional<bool> final_gather;
  int spp = 16;                            // samples per pixel, before adaptive ones
  Balance sample_balance = Balance::kOff;  // kOn: spp is multiplied where paths bring what photons would
  // Work that adaptive samples may add, as a fraction of that of the first spp; 0: none. The default was
  // measured (docs/decisions/009-adaptive-samples.md).
  float adaptive = 0.75f;
  uint64_t seed = 0;
  int threads = 0;            // 0: all that the process may use
  int width = 0, height = 0;  // 0: as in the scene
  CropWindow crop;
  // Whether to measure the kernels' bias, once per pixel and pass; unset: no.
  std::optional<bool> estimate_bias;
  std::optional<bool> denoise;  // whether to filter the picture; unset: no
  // Layers to write besides the image; empty = none, "all" = all, "denoising" = those that denoisers read.
  std::vector<std::string> aov;
  // Number of passes among which photons and spp are divided; 0: as many as are needed for the photons of one
  // pass to fit into photon_memory.
  uint64_t passes = 0;
  // Bytes that the process may hold in all; 0: as many as the system leaves it.
  uint64_t memory = 0;
  // Bytes that the photons of a pass may take while they are shot and their maps are built: what is left of
  // `memory` in a render of one pass, and how much less it is in a render of several, which keeps sums.
  uint64_t photon_memory = std::numeric_limits<uint64_t>::max(), sums_memory = 0;
};

// The name in `aov` of the layers and halves that denoisers read.
inline constexpr const char* kDenoisingLayers = "denoising";
// Whether `aov` asks for what denoisers read.
bool names_denoising(const std::vector<std::string>& aov);
// Whether a render keeps its samples in halves (render/film/halves.h).
bool keeps_halves(const RenderSettings& settings);

}  // namespace kaustik::render
