#include "apps/session/stopping/path_choice.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/plan/plan.h"

namespace kaustik::app {

namespace {

using render::PixelHalves;

// A class that has less than this share of the light need not be known by itself.
constexpr double kNegligible = 0.03;
// Largest relative standard error of a mean, and largest share of one pixel in it.
constexpr double kKnown = 0.1, kMostOfPixel = 0.05;
// By how much the mean of a map from few photons may exceed that of paths, beyond what noise explains.
constexpr double kBiasOfMap = 0.15;
// kSeen: largest relative standard error of a class of little light, of which paths found some. kRarer: paths
// that no sample found are taken to be this many times as bright as the brightest that was found.
constexpr double kSeen = 0.3, kRarer = 3;
// Paths take the place of maps where their error is at most this share of the maps': a short trial misses
// rare bright paths. Where paths for one class have kHopeless times the maps' error, those for more classes
// are not tried.
constexpr double kWorthPaths = 0.7, kHopeless = 4;

// Sums of a class over the pixels of both trials.
struct ClassSums {
  double maps = 0, paths = 0;
  double squared_error = 0, brightest = 0;  // of the paths

  void add(const PixelHalves::Pair& map, const PixelHalves::Pair& path) {
    maps += map.mean(), paths += path.mean();
    squared_error += path.error() * path.error();
    brightest = std::max(brightest, path.mean());
  }
  double error() const { return std::sqrt(squared_error); }
  // Light of the maps that the paths did not see, beyond noise and the bias of maps from few photons.
  double missing() const { return std::max((1 - kBiasOfMap) * maps - paths - 3 * error(), 0.0); }

  bool known(double picture) const {
    const double unsure = std::max(error() / kKnown, brightest / kMostOfPixel);
    if (unsure > std::max(paths, kNegligible * picture)) return false;
    return missing() == 0 || (maps < kNegligible * picture && error() < kSeen * paths);
  }
  // Variance of a sample, relative to the square of the picture's mean, that the missing light adds if it
  // comes in events kRarer times as bright as the brightest that was seen.
  double variance_of_missing(double picture, double pixels) const {
    const double event = kRarer * render::kTrialSamples * brightest * pixels / picture;
    return missing() / picture * event;
  }
};

double squared(double v) {
  return v * v;
}

// Adds what one block of both trials says; mean: of the picture.
void compare_blocks(const std::vector<PixelHalves>& maps, const std::vector<PixelHalves>& paths, double mean,
                    TrialComparison* sum) {
  const double pixels = double(maps.size());
  double light_of_maps = 0, light_of_paths = 0, noise_of_maps = 0, noise_of_paths = 0, difference = 0,
         noise = 0;
  for (size_t k = 0; k < maps.size(); ++k) {
    const PixelHalves &a = maps[k], &b = paths[k];
    light_of_maps += a.all.mean() / pixels, light_of_paths += b.all.mean() / pixels;
    noise_of_maps += squared(a.all.error()) / pixels;
    noise_of_paths += squared(b.all.error()) / pixels;
    difference += (a.caustic.mean() + a.indirect.mean() - b.caustic.mean() - b.indirect.mean()) / pixels;
    noise += squared((a.caustic.error() + a.indirect.error()) / pixels) +
             squared((b.caustic.error() + b.indirect.error()) / pixels);
  }
  // Of few samples a path may miss the light, and a map of few photons be too dark.
  const double unit = render::relative_unit(std::max(light_of_maps, light_of_paths), mean);
  if (!(unit > 0)) return;
  sum->variance_of_maps += noise_of_maps * render::kTrialSamples / unit;
  sum->variance_of_paths += noise_of_paths * render::kTrialSamples / unit;
  sum->error_of_maps += (squared(difference) - noise) / unit;
}

}  // namespace

std::vector<TakenByPaths> path_candidates(const Scene& scene, const render::RenderSettings& settings,
                                          const render::EstimatorPlan& plan) {
  const bool indirect = plan.indirect == render::IndirectEstimator::kFinalGather && !settings.indirect;
  if (settings.method != render::Method::kAuto || !indirect) return {};
  std::vector<TakenByPaths> candidates{TakenByPaths::kIndirect};
  const bool hit_all_lights = std::ranges::none_of(scene.lights, [](const Light& l) { return is_delta(l); });
  if (plan.caustics == render::CausticEstimator::kPhotons && !settings.caustics && hit_all_lights)
    candidates.push_back(TakenByPaths::kIndirectAndCaustics);
  return candidates;
}

render::RenderSettings with_paths(render::RenderSettings settings, TakenByPaths classes) {
  settings.indirect = render::IndirectEstimator::kPaths;
  if (classes == TakenByPaths::kIndirectAndCaustics) settings.caustics = render::CausticEstimator::kPaths;
  return settings;
}

std::string options_of(TakenByPaths classes) {
  return classes == TakenByPaths::kIndirectAndCaustics ? " --caustics paths --indirect paths"
                                                       : " --indirect paths";
}

TrialComparison compare_trials(TakenByPaths classes, const render::SampleTrial& maps,
                               const render::SampleTrial& paths) {
  const size_t blocks = std::min(maps.blocks.size(), paths.blocks.size());
  double picture = 0, pixels = 0;
  ClassSums caustic, indirect;
  for (size_t i = 0; i < blocks; ++i)
    for (size_t k = 0; k < maps.blocks[i].size(); ++k) {
      const PixelHalves &a = maps.blocks[i][k], &b = paths.blocks[i][k];
      picture += b.all.mean(), ++pixels;
      caustic.add(a.caustic, b.caustic), indirect.add(a.indirect, b.indirect);
    }
  TrialComparison found;
  for (size_t i = 0; i < blocks; ++i)
    compare_blocks(maps.blocks[i], paths.blocks[i], picture / std::max(pixels, 1.0), &found);
  const double share = 1 / double(std::max<size_t>(blocks, 1));
  found.variance_of_maps *= share, found.variance_of_paths *= share;
  found.error_of_maps = std::max(found.error_of_maps * share, 0.0);
  found.paths_are_known = indirect.known(picture);
  if (picture > 0) found.variance_of_paths += indirect.variance_of_missing(picture, pixels);
  if (classes != TakenByPaths::kIndirectAndCaustics) return found;
  found.paths_are_known &= caustic.known(picture);
  if (picture > 0) found.variance_of_paths += caustic.variance_of_missing(picture, pixels);
  return found;
}

double share_of_map_error(double photons_of_trial, double photons) {
  return std::min(std::pow(photons_of_trial / photons, 2.0 / 3), 1.0);
}

std::optional<PathTrial> choose_paths(const render::RenderInput& input, const render::SampleTrial& maps,
                                      const TryPaths& try_paths, const JudgePaths& judge) {
  std::optional<PathTrial> best;
  double least = HUGE_VAL;
  for (const TakenByPaths classes : path_candidates(input.scene, input.settings, input.plan)) {
    PathTrial tried{classes, with_paths(input.settings, classes), {}, {}};
    tried.plan = render::make_plan(tried.settings, input.scene.needs);
    tried.sample = try_paths({input.scene, input.bvh, tried.settings, tried.plan});
    const TrialComparison found = compare_trials(classes, maps, tried.sample);
    const ErrorsAtCost errors = judge(found, tried);
    if (errors.of_paths > kHopeless * errors.of_maps) break;
    if (errors.of_paths >= std::min(least, kWorthPaths * errors.of_maps) || !found.paths_are_known) continue;
    least = errors.of_paths;
    best = std::move(tried);
  }
  return best;
}

}  // namespace kaustik::app
