#pragma once
// One render, start to end: pass by pass, shoot, build the maps, render tiles, in fixed order.

#include <functional>
#include <memory>
#include <string_view>

#include "accel/bvh.h"
#include "render/film/film.h"
#include "render/passes/pass_sums.h"
#include "render/settings.h"
#include "render/statistics.h"

namespace kaustik::render {

struct FirstPhotons;  // pass_trials.h

struct Progress {
  std::string_view phase;         // "photons", "build", "render"
  uint64_t done = 0, total = 0;   // of the phase in this pass
  uint64_t pass = 0, passes = 1;  // photons, build, render follow each other in each pass; 0: who knows
};
// Called from worker threads, serialised by the renderer; returning false cancels.
using ProgressCallback = std::function<bool(const Progress&)>;

// What to render of a scene and its settings.
struct RenderTask {
  // Passes that the result is to hold: empty, all that the settings ask for.
  PassSet passes{};
  // Complete passes of an earlier render with the same settings; they are not rendered again.
  PassSums done{};
  // Called after each pass, with all that are complete; false when they are enough.
  std::function<bool(const PassSums&)> after_pass{};
  // Without it a render of a single pass leaves no totals in result.sums: it takes half the memory for them.
  bool keep_sums = true;
  // Of a single pass, with the same settings but for the number of samples: they are taken from here.
  std::shared_ptr<FirstPhotons> photons{};
};

// What the film shows.
enum class Shown {
  kPasses,  // the mean of all complete passes
  kTiles,   // none is complete: the finished tiles of the first that was begun, black elsewhere
  kNothing  // no tile either
};

struct RenderResult {
  Film film;
  RenderStatistics statistics;  // of what the film shows
  EstimatorPlan plan;
  bool cancelled = false;
  Shown shown = Shown::kNothing;
  PassSums sums;             // the complete passes; totals as RenderTask::keep_sums says
  double error = kInfinity;  // of what the film shows, see relative_error(); infinite where it is unknown
};

// Chooses the estimators: the method's preset, then the settings' overrides, then what the scene does not
// need is left out. Pure. notes[0] names the choice; each further note says what was left out or is missing,
// and why.
EstimatorPlan make_plan(const RenderSettings& settings, const SceneNeeds& needs);

// Film, its error and statistics of result->sums, whose totals are there.
void show_passes(RenderResult* result);

// Renders within the calling task arena. settings.width/height are already applied to scene.camera by the
// caller; settings.crop selects the film's window. Bit-identical for any number of threads, for any split of
// the passes over calls, and for a scene scaled by a power of two. Throws std::invalid_argument for a crop
// outside the image or senseless settings (spp < 1, max_bounces < 1, radius not positive and finite, alpha
// not in (0, 1], more passes than photons, task.passes without settings.passes).
RenderResult render(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                    const ProgressCallback& progress = {}, RenderTask task = {});

}  // namespace kaustik::render
