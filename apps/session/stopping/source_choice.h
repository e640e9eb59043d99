#pragma once
// Names photons or paths alone where dividing the light between them is not worth it.

#include <string>

#include "accel/bvh.h"
#include "core/scene/scene.h"
#include "render/maps/photon_shoots.h"

namespace kaustik::app {

// The settings with indirect light and caustics from photons where the plan divides them; or from paths where
// method auto chose photons for them, but for what comes through specular surfaces from lights that no ray
// can hit.
render::RenderSettings with_photons(render::RenderSettings settings, const render::EstimatorPlan& plan);
render::RenderSettings with_paths(render::RenderSettings settings, const render::EstimatorPlan& plan,
                                  const Scene& scene);

// The options that name the estimators which `given` leaves open, each after a space.
std::string options_of(const render::RenderSettings& settings, const render::RenderSettings& given);

// What photons are worth beside paths.
struct PhotonWorth {
  double error = 0;   // LearnedSplit::error; 0 where nothing is divided
  bool light = true;  // LearnedSplit::light
};

// Where the plan divides light between photons and paths, finds out from few photons what that is worth
// (render/maps/learn_split.h), and names one of them in the settings if it does as well alone. Returns the
// options that say so, each after a space; empty where nothing is named. The result depends on scene and
// settings alone, so that the parts of a render choose alike. guides: receives what was learned that a render
// with these settings needs; may be null. worth: is set where the plan divides light; may be null. Call it
// within the render's task arena.
std::string settle_sources(const Scene& scene, const accel::Bvh& bvh, render::RenderSettings* settings,
                           render::PhotonGuides* guides = nullptr, PhotonWorth* worth = nullptr);

}  // namespace kaustik::app
