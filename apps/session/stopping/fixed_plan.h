#pragma once
// Chooses between photon maps and paths where the numbers of photons and samples are fixed.

#include <memory>
#include <string>

#include "accel/bvh.h"
#include "apps/settings/setting_options.h"
#include "core/scene/scene.h"
#include "render/maps/pass_photons.h"

namespace kaustik::app {

// Whether a trial may choose paths. It may not where the command line gives --photons or another setting that
// only maps read, such as a radius, nor where the picture must state the bias of its maps.
bool may_choose_paths(const Settings& settings, const SettingOverrides& given, const SceneNeeds& needs);

// What the trial leaves to the render, for render::RenderTask.
struct TrialWork {
  std::shared_ptr<render::FirstPhotons> photons;    // of a single pass that keeps its maps, or null
  std::shared_ptr<render::ExploredScene> explored;  // null: no trial was worth it
  std::string
      paths;  // the options by which paths replace photon maps, each after a space; empty where none does
};

// Tries paths beside maps of few photons, and names them in the settings where they leave less error for as
// much work, counted in rays and gathers. The result depends on scene and settings alone, unless memory
// requires passes: no clock decides, so that the parts of a render, and renders on other machines, choose
// alike. The trial takes a few per cent of the render. Call it within the render's task arena.
TrialWork settle_paths(const Scene& scene, const accel::Bvh& bvh, const render::ProgressCallback& progress,
                       Settings* settings);

}  // namespace kaustik::app
