#pragma once
// Renders a scene pass by pass: shoots photons, builds the maps, renders tiles, in a fixed order.

#include <functional>
#include <memory>

#include "accel/bvh.h"
#include "render/film/halves.h"
#include "render/passes/pass_sums.h"
#include "render/plan/plan.h"
#include "render/plan/progress.h"
#include "render/tiles/tiles.h"

namespace kaustik::render {

struct ExploredScene;  // render/maps/pass_photons.h
struct FirstPhotons;

// Which passes to render, and what to do with them.
struct RenderTask {
  // Passes that the result must contain; empty: all passes of the settings.
  PassSet passes{};
  // Complete passes of an earlier render with the same settings, which are not rendered again. Its radii
  // count even if it has no passes.
  PassSums done{};
  // The passes one after the other in place of `passes`, which then only bounds them; nothing ends the
  // render. It may wait. Each pass may be rendered once.
  std::function<std::optional<uint64_t>()> next_pass{};
  // Called before the tiles of the first pass that is rendered, with the sums so far and the radii.
  std::function<void(const PassSums&)> begun{};
  // Called after each pass with the sums of all complete passes, which it may move away or clear: later
  // passes then begin new sums. Returning false ends the render.
  std::function<bool(PassSums&)> after_pass{};
  // If false, a render of a single pass returns no totals in result.sums, which halves the memory for pixels.
  bool keep_sums = true;
  // Decides about the adaptive samples of a single-pass render in place of settings.adaptive, which must not
  // be 0; render/tiles/tiles.h. Settings with the result's statistics.adaptive_work give the same bits.
  std::function<double(double done, double seconds)> adaptive_work{};
  // Follows the first pass that is rendered; render/tiles/tiles.h. Changes neither bits nor counts.
  PixelsCallback on_pixels{};
  // RenderInput::views; empty: the scene's camera.
  std::vector<Camera> views{};
  // Photons of a single-pass render that were shot in advance, with the same settings except for the number
  // of samples; they are moved from here.
  std::shared_ptr<FirstPhotons> photons{};
  // What earlier photons of the scene found out about it; null: nothing. Not read if there are photons.
  std::shared_ptr<ExploredScene> explored{};
};

// What the film contains.
enum class Shown {
  kPasses,  // the mean of all complete passes
  kTiles,   // no pass is complete: the finished tiles of the first one, black elsewhere
  kNothing  // not even a tile
};

struct RenderResult {
  Film film;
  RenderStatistics statistics;  // statistics of what the film shows
  EstimatorPlan plan;
  bool cancelled = false;
  Shown shown = Shown::kNothing;
  HalfFilm halves;           // of the film, if keeps_halves(settings); empty otherwise
  PassSums sums;             // the complete passes; has totals as RenderTask::keep_sums says
  double error = kInfinity;  // of what the film shows, see relative_error(); infinite if unknown
};

// Sets film, halves, error and statistics from result->sums, which must have totals.
void show_passes(RenderResult* result);

// The sums of no pass of these settings, with the radii that its first pass has, so that each part of a
// render need not find them again. Empty if the progress callback cancelled.
std::optional<PassSums> begin_passes(const Scene& scene, const accel::Bvh& bvh,
                                     const RenderSettings& settings, const ProgressCallback& progress);

// Renders within the calling task arena. The caller has already applied settings.width and height to
// scene.camera; settings.crop selects the film's window. The result has the same bits for any number of
// threads, for any split of the passes over calls, and for a scene scaled by a power of two. Throws
// std::invalid_argument for a crop outside the image or invalid settings (spp < 1, max_bounces < 1, radius
// not positive and finite, alpha not in (0, 1], more passes than photons, task.passes without
// settings.passes).
RenderResult render(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                    const ProgressCallback& progress = {}, RenderTask task = {});

}  // namespace kaustik::render
