#pragma once
// Chooses the photons and samples that fill --time.

#include <functional>
#include <memory>
#include <string>

#include "accel/bvh.h"
#include "apps/console/console.h"
#include "apps/settings/setting_options.h"
#include "core/scene/scene.h"
#include "core/stopwatch.h"
#include "render/passes/pass_trials.h"

namespace kaustik::app {

// Whether trials choose photons, samples and passes in place of the scene's settings. They do if --time is
// given without photons, samples or quality. They do not if passes are needed, because of --passes, an error
// estimate, or files that hold passes (`writes_passes`), nor for path tracing, which can stop after any pass.
bool time_decides(const Settings& settings, const SettingOverrides& given, const SceneNeeds& needs,
                  bool writes_passes);

// A render that was planned to fill a time.
struct FilledTime {
  bool single_pass = false;  // one pass, in which adaptive samples are placed best
  // The photons are those of the single pass, if it gathers any, without radii if the progress callback
  // cancelled. A render without photons has passes.
  std::shared_ptr<render::FirstPhotons> photons{};
  std::shared_ptr<render::ExploredScene> explored{};
  // The options that name photons or paths, each after a space, and why, for the log; may be null.
  std::string sources{};
  const char* sources_because = nullptr;
  // For render::RenderTask: chooses the adaptive samples of a single pass while it is rendered. May be empty.
  std::function<double(double done, double seconds)> adaptive_work{};
};

// Chooses photons, samples and passes by short trial renders, and logs them. If a single pass would be long,
// plans an open-ended number of passes. `total`: started with the command. `seconds_after`: what follows the
// render. Call it within the render's task arena. The arguments must outlive the result.
FilledTime settle_time(const Scene& scene, const accel::Bvh& bvh, const Stopwatch& total,
                       double seconds_after, const render::ProgressCallback& progress, const Console& console,
                       Settings* settings);

}  // namespace kaustik::app
