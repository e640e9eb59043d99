#pragma once
// Decides where paths take the place of photon maps.

#include <vector>

#include "core/scene/scene.h"
#include "render/passes/pass_trials.h"

namespace kaustik::app {

// Classes that are taken from paths. Under an open sky, or in a studio, they have less noise than the samples
// of a map at equal time, and none of its bias.
struct PathClasses {
  bool caustics = false, indirect = false;
};

// What may replace the maps of a plan of method `auto`, from few classes to all. Estimators that the settings
// name stay, and so do caustics of lights that no path can hit. Caustics alone are not replaced: the paths
// that look for them bring indirect light with them.
std::vector<PathClasses> path_candidates(const Scene& scene, const render::RenderSettings& settings,
                                         const render::EstimatorPlan& plan);

// The settings with these classes from paths.
render::RenderSettings with_paths(render::RenderSettings settings, const PathClasses& classes);

// A trial with photon maps beside one with paths, in the blocks of both. Errors and variances are relative to
// the square of the light of their block, to which the square of a tenth of the picture's mean is added.
struct TrialComparison {
  double variance_of_maps = 0, variance_of_paths = 0;  // of one sample
  // Of the caustic and indirect light that maps give, at the scale of a block: what differs beyond noise.
  double error_of_maps = 0;
  // Whether the trial met enough of the light that paths bring to be believed: the means of the classes are
  // known within a tenth, not less than those of the maps by more than 15 %, and no pixel brings much of
  // them. Light that paths meet seldom is missing from most trials; then their noise looks small. Of a class
  // of less than 3 % of the light, what is missing counts as noise instead.
  bool paths_are_known = false;
};
TrialComparison compare_trials(const PathClasses& classes, const render::SampleTrial& maps,
                               const render::SampleTrial& paths);

}  // namespace kaustik::app
