#pragma once
// One render, start to end: shoot, build the maps, render tiles, in fixed order.

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "accel/bvh.h"
#include "photon/tracer.h"
#include "render/film.h"
#include "render/settings.h"

namespace kaustik::render {

struct RayCounters {
  uint64_t camera = 0, specular = 0, shadow = 0, bounce = 0;  // paths' segments by what they are traced for
  RayCounters& operator+=(const RayCounters& o);
};

// How the lecture's direct estimator answered (per shading point).
struct LectureCounters {
  uint64_t from_photons = 0, climbed = 0;  // climbed: used a parent of the leaf
  uint64_t fallback_few = 0, fallback_shadow = 0,
           fallback_face = 0;  // M <= M0, shadow photon in the node, too near a face
  LectureCounters& operator+=(const LectureCounters& o);
};

struct RenderStatistics {
  photon::TraceCounters photons;
  RayCounters rays;
  LectureCounters lecture;
  uint64_t gather_queries = 0, gather_candidates = 0, gather_accepted = 0;
  uint64_t dropped_samples = 0;  // NaN, infinite or negative; reported with pixel and sample
  std::vector<std::string> dropped_examples;
  double photon_trace_s = 0, photon_build_s = 0, render_s = 0;
  float radius = 0;  // r0 used, metres: the largest of the maps' radii; 0 when no map was read
  float direct_radius = 0, caustic_radius = 0, indirect_radius = 0;  // 0 where the map was not built
  uint64_t photon_bytes = 0;  // maps of a pass, index included; the largest
  uint64_t octree_nodes = 0;  // of all maps
  uint64_t passes = 0;        // finished
};

struct Progress {
  std::string_view phase;         // "photons", "build", "render"
  uint64_t done = 0, total = 0;   // of the phase in this pass
  uint64_t pass = 0, passes = 1;  // photons, build, render follow each other in each pass
};
// Called from worker threads, serialised by the renderer; returning false cancels.
using ProgressCallback = std::function<bool(const Progress&)>;

struct RenderResult {
  Film film;
  RenderStatistics statistics;
  EstimatorPlan plan;
  bool cancelled = false;
};

// Chooses the estimators: the method's preset, then the settings' overrides, then what the scene does not
// need is left out. Pure. notes[0] names the choice; each further note says what was left out or is missing,
// and why.
EstimatorPlan make_plan(const RenderSettings& settings, const SceneNeeds& needs);

// Renders within the calling task arena. settings.width/height are already applied to scene.camera by the
// caller; settings.crop selects the film's window. Bit-identical for any number of threads, and for a scene
// scaled by a power of two. Throws std::invalid_argument for a crop outside the image or senseless settings
// (spp < 1, max_bounces < 1, radius not positive and finite, more passes than photons).
RenderResult render(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                    const ProgressCallback& progress = {});

}  // namespace kaustik::render
