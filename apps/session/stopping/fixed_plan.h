#pragma once
// Chooses between photon maps and paths where the numbers of photons and samples are fixed.

#include "accel/bvh.h"
#include "apps/session/stopping/path_choice.h"
#include "apps/settings/setting_options.h"
#include "core/scene/scene.h"

namespace kaustik::app {

// Whether a trial may choose paths. It may not where the command line gives --photons or another setting that
// only maps read, such as a radius, nor where the picture must state the bias of its maps.
bool may_choose_paths(const Settings& settings, const SettingOverrides& given, const SceneNeeds& needs);

// Tries paths beside maps of few photons, and names them in the settings where they leave less error for as
// much work, counted in rays and gathers. The result depends on scene and settings alone, unless memory
// requires passes: no clock decides, so that the parts of a render choose alike on all machines of one
// instruction set. The photons are those of a single pass that keeps its maps. The trial takes a few per cent
// of the render, and nothing is left of it where it is not worth that. Call it within the render's task
// arena.
TrialWork settle_paths(const Scene& scene, const accel::Bvh& bvh, const render::ProgressCallback& progress,
                       Settings* settings);

}  // namespace kaustik::app
