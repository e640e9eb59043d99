#include "apps/session/stopping/source_choice.h"

#include <fmt/format.h>

#include <algorithm>

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
  const bool split_caustics = plan.caustics == CausticEstimator::kSplit;
  if (!settings.indirect && reads_indirect_photons(plan) && (hits_all || !split_caustics))
    settings.indirect = IndirectEstimator::kPaths;
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
  return options;
}

std::string settle_sources(const Scene& scene, const accel::Bvh& bvh, render::RenderSettings* settings,
                           render::PhotonGuides* guides, double* error) {
  const render::EstimatorPlan plan = render::make_plan(*settings, scene.needs);
  if (!splits_sources(plan)) return {};
  render::PhotonGuides learned;
  render::learn_sources({scene, bvh, *settings, plan}, &learned);
  if (error) *error = learned.split->error;
  const bool photons = learned.split->photons, paths = learned.split->sources.leaves_to_paths();
  const render::RenderSettings given = *settings;
  if (!paths || !photons) {
    *settings = paths ? with_paths(given, plan, scene) : with_photons(given, plan);
    learned.split = nullptr;
  }
  if (guides && photons) *guides = std::move(learned);
  return options_of(*settings, given);
}

}  // namespace kaustik::app
