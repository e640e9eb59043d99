#pragma once
// --time: how many photons and samples fill it.

#include <memory>

#include "accel/bvh.h"
#include "apps/console/console.h"
#include "apps/settings/setting_options.h"
#include "core/scene/scene.h"
#include "core/stopwatch.h"
#include "render/passes/pass_trials.h"

namespace kaustik::app {

// Whether the time is all that was said of how much is to be rendered: then trials choose photons, samples
// and passes, in place of the scene's. Not where passes are asked for: by name, by the error that they tell,
// or by files that hold them (writes_passes). Nor where no photons are read: paths have no further samples,
// and come in passes as well as in one.
bool time_decides(const Settings& settings, const SettingOverrides& given, const SceneNeeds& needs,
                  bool writes_passes);

// Chooses them, by trials; the log says what. One pass, whose samples are placed best, whose photons are then
// returned (without radii: progress cancelled); or as many passes as come, where that one would be long:
// null. total: started when the command was. Within the render's task arena.
std::shared_ptr<render::FirstPhotons> settle_time(const Scene& scene, const accel::Bvh& bvh,
                                                  const Stopwatch& total,
                                                  const render::ProgressCallback& progress,
                                                  const Console& console, Settings* settings);

}  // namespace kaustik::app
