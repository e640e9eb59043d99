#include "apps/session/stopping/source_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/settings/names.h"

namespace kaustik::app {

using render::CausticEstimator;
using render::IndirectEstimator;

render::RenderSettings with_photons(render::RenderSettings settings, const render::EstimatorPlan& plan) {
  if (plan.indirect == IndirectEstimator::kSplit) settings.indirect = IndirectEstimator::kPhotons;
  if (plan.caustics == CausticEstimator::kSplit) settings.caustics = CausticEstimator::kPhotons;
  return settings;
}

render::RenderSettings with_paths(render::RenderSettings settings, const render::EstimatorPlan& plan,
                                  const Scene& scene) {
  if (settings.method != render::Method::kAuto) return settings;
  const bool hits_all = std::ranges::none_of(scene.lights, is_delta);
  if (!settings.indirect && reads_indirect_photons(plan)) settings.indirect = IndirectEstimator::kPaths;
  if (!settings.caustics && reads_caustic_photons(plan) && hits_all)
    settings.caustics = CausticEstimator::kPaths;
  return settings;
}

std::string options_of(const render::RenderSettings& settings, const render::RenderSettings& given) {
  std::string options;
  if (settings.caustics && !given.caustics)
    options += fmt::format(" --caustics {}", render::name_of(*settings.caustics));
  if (settings.indirect && !given.indirect)
    options += fmt::format(" --indirect {}", render::name_of(*settings.indirect));
  if (settings.final_gather != given.final_gather)
    options += fmt::format(" --final-gather {}", settings.final_gather.value_or(false) ? "on" : "off");
  return options;
}

namespace {

// Multiplies the samples if they may be. noise: squared, of as many as are set, over 64 pixels.
void balance_samples(double noise, render::RenderSettings* settings) {
  // 8 samples are enough for light of which they leave this squared noise.
  constexpr double kEven = 0.003, kSamples = 8, kMost = 16;
  constexpr int kEnough = 1024;
  if (std::exchange(settings->sample_balance, render::Balance::kOff) == render::Balance::kOff) return;
  const double factor = std::clamp(noise * settings->spp / (kEven * kSamples), 1.0, kMost);
  // Numbers of samples that are powers of two are distributed best, and presets have such.
  for (long n = std::lround(std::log2(factor)); n > 0 && 2 * settings->spp <= kEnough; --n)
    settings->spp *= 2;
}

}  // namespace

std::string settle_sources(const Scene& scene, const accel::Bvh& bvh, render::RenderSettings* settings,
                           render::PhotonGuides* guides, PhotonWorth* worth) {
  const render::EstimatorPlan plan = render::make_plan(*settings, scene.needs);
  if (!splits_sources(plan)) {
    // In media nothing tells the noise of paths, which is large.
    if (settings->method == render::Method::kAuto && plan.indirect == IndirectEstimator::kPaths &&
        scene.needs.scattering)
      balance_samples(HUGE_VAL, settings);
    return {};
  }
  render::PhotonGuides learned;
  render::learn_sources({scene, bvh, *settings, plan}, &learned);
  if (worth) *worth = {learned.split->error, learned.split->light};
  const bool photons = learned.split->photons, paths = learned.split->sources.leaves_to_paths();
  const render::RenderSettings given = *settings;
  balance_samples(learned.split->noise, settings);
  if (!paths || !photons) {
    *settings = paths ? with_paths(*settings, plan, scene) : with_photons(*settings, plan);
    learned.split = nullptr;
  }
  // Who learns the division later knows the new number alone.
  if (settings->spp != given.spp) learned.split = nullptr;
  if (guides && photons) *guides = std::move(learned);
  return options_of(*settings, given);
}

}  // namespace kaustik::app
