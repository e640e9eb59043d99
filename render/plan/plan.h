#pragma once
// Chooses the estimator of each class of paths.

#include <string>
#include <vector>

#include "core/scene/needs.h"
#include "photon/trace/trace_settings.h"
#include "render/settings/settings.h"

namespace kaustik::render {

// The estimators that a render uses, determined by method, settings and the scene's needs.
struct EstimatorPlan {
  DirectEstimator direct = DirectEstimator::kShadowRays;
  CausticEstimator caustics = CausticEstimator::kOff;
  IndirectEstimator indirect = IndirectEstimator::kOff;
  // Light that arrives by way of specular surfaces in the faint directions of a glossy lobe comes from the
  // caustic map (render/estimators/glossy_tails.h).
  bool glossy_tails = false;
  // Whether light that media scatter comes from photons gathered along rays: caustics, and indirect light.
  // Otherwise paths find it.
  bool medium_caustics = false, medium_indirect = false;
  // Paths that look for indirect light end where few photons tell what light arrives
  // (render/maps/path_ends.h).
  bool ends_paths = false;
  std::vector<std::string> notes;  // one sentence each: what was chosen or left out, and why
};

// Chooses the estimators: the method's preset, then the settings' overrides; then estimators that the scene
// does not need are left out. Pure function. notes[0] names the choice; each further note says what was left
// out or is missing, and why.
EstimatorPlan make_plan(const RenderSettings& settings, const SceneNeeds& needs);

// Photon kinds that the plan's estimators use; only these are traced and stored.
photon::KindMask kinds_needed(const EstimatorPlan& plan);
// Whether there are any, for the plan of these settings.
inline bool needs_photons(const RenderSettings& settings, const SceneNeeds& needs) {
  return kinds_needed(make_plan(settings, needs)).any();
}

// Whether the estimator samples the lights; then it shares direct light with paths that leave the point
// anyway.
inline bool samples_lights(DirectEstimator direct) {
  return direct == DirectEstimator::kShadowRays || direct == DirectEstimator::kPredicted;
}

// Whether indirect light is read from a photon map.
inline bool reads_indirect_photons(const EstimatorPlan& plan) {
  return plan.indirect == IndirectEstimator::kPhotons || plan.indirect == IndirectEstimator::kSplit;
}

// Whether caustics are read from a photon map.
inline bool reads_caustic_photons(const EstimatorPlan& plan) {
  return plan.caustics == CausticEstimator::kPhotons || plan.caustics == CausticEstimator::kSplit;
}

// Whether photons and paths divide some light by its sources.
inline bool splits_sources(const EstimatorPlan& plan) {
  return plan.caustics == CausticEstimator::kSplit || plan.indirect == IndirectEstimator::kSplit;
}

// Whether paths are followed from the camera side at every point.
inline bool traces_paths(const EstimatorPlan& plan) {
  return plan.caustics == CausticEstimator::kPaths || plan.indirect == IndirectEstimator::kPaths ||
         splits_sources(plan);
}

}  // namespace kaustik::render
