#pragma once
// Decides where paths take the place of photon maps.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "render/passes/pass_trials.h"

namespace kaustik::app {

// Classes that come from paths in place of photon maps. Under an open sky, or in a studio, paths have less
// noise than the samples of a map at equal cost, and none of its bias. Caustics alone are not replaced: the
// paths that look for them bring indirect light with them.
enum class TakenByPaths { kIndirect, kIndirectAndCaustics };

// What may replace the maps of a plan of method `auto`, from few classes to all. Estimators that the settings
// name stay, and so do caustics of lights that no path can hit.
std::vector<TakenByPaths> path_candidates(const Scene& scene, const render::RenderSettings& settings,
                                          const render::EstimatorPlan& plan);

// The settings with these classes from paths.
render::RenderSettings with_paths(render::RenderSettings settings, TakenByPaths classes);

// The options that name these estimators, each after a space.
std::string options_of(TakenByPaths classes);

// A trial with photon maps beside one with paths, in the blocks of both. Errors and variances are relative to
// the square of the light of their block, to which the square of a tenth of the picture's mean is added.
struct TrialComparison {
  double variance_of_maps = 0, variance_of_paths = 0;  // of one sample
  // Squared error of the maps' caustic and indirect light, averaged over a block, beyond the noise of both
  // trials.
  double error_of_maps = 0;
  // Whether the trial met enough of the light that paths bring to be believed: the means of the classes are
  // known within a tenth, not less than those of the maps by more than 15 %, and no pixel brings much of
  // them. Light that paths meet seldom is missing from most trials; then their noise looks small. Of a class
  // of less than 3 % of the light, what is missing counts as noise instead.
  bool paths_are_known = false;
};
TrialComparison compare_trials(TakenByPaths classes, const render::SampleTrial& maps,
                               const render::SampleTrial& paths);

// The error of maps of this many photons, as a share of that in the trial.
double share_of_map_error(double photons_of_trial, double photons);

// A render with paths in place of photon maps that was tried.
struct PathTrial {
  TakenByPaths classes{};
  render::RenderSettings settings;
  render::EstimatorPlan plan;
  render::SampleTrial sample;
};
// Errors of the picture at the cost that both may have: with its photon maps, and with paths.
struct ErrorsAtCost {
  double of_maps = 0, of_paths = 0;
};
using TryPaths = std::function<render::SampleTrial(const render::RenderInput& input)>;
using JudgePaths = std::function<ErrorsAtCost(const TrialComparison& found, const PathTrial& paths)>;

// What trials leave to the render.
struct TrialWork {
  // For render::RenderTask; both may be null.
  std::shared_ptr<render::FirstPhotons> photons{};
  std::shared_ptr<render::ExploredScene> explored{};
  // The options by which paths replace photon maps, each after a space; empty where none does.
  std::string paths{};
};

// What the log says where paths were chosen.
inline constexpr const char* kPathsTaken =
    "trials found less error for the same work with paths in place of photon maps";

// Tries the candidates beside a trial with the maps of `input`. Returns the one of the least error if that is
// at most 0.7 of the maps', since a short trial misses rare bright paths, and if the paths are known.
std::optional<PathTrial> choose_paths(const render::RenderInput& input, const render::SampleTrial& maps,
                                      const TryPaths& try_paths, const JudgePaths& judge);

}  // namespace kaustik::app
