// make_plan(): chooses the estimator of each class of paths.

#include "render/plan/plan.h"

#include <fmt/format.h>

#include "render/settings/names.h"

namespace kaustik::render {

namespace {

using Direct = DirectEstimator;
using Caustic = CausticEstimator;
using Indirect = IndirectEstimator;

// The estimators that the method prescribes.
EstimatorPlan preset(Method method, const SceneNeeds& needs) {
  EstimatorPlan plan;
  switch (method) {
    case Method::kRaytrace:
      plan.direct = Direct::kShadowRays, plan.caustics = Caustic::kOff, plan.indirect = Indirect::kOff;
      break;
    case Method::kMc:
      plan.direct = Direct::kShadowRays, plan.caustics = Caustic::kPaths, plan.indirect = Indirect::kPaths;
      break;
    case Method::kHybrid:
      plan.direct = Direct::kLecture, plan.caustics = Caustic::kPhotons, plan.indirect = Indirect::kPaths;
      break;
    case Method::kPhoton:
      plan.direct = Direct::kPhotons, plan.caustics = Caustic::kPhotons, plan.indirect = Indirect::kPhotons;
      break;
    case Method::kAuto:
      // Direct light with predicted visibility has the error of shadow rays in less time. Nothing is
      // predicted for a sky, since part of it is visible nearly everywhere, nor without surfaces that photons
      // could light. Photons carry what small bright places send on, which paths seldom meet; paths find the
      // rest without the bias of discs (docs/decisions/065-light-is-divided-by-its-sources.md).
      plan.direct =
          needs.any_light && needs.diffuse && !needs.sky_alone ? Direct::kPredicted : Direct::kShadowRays;
      plan.caustics = Caustic::kSplit, plan.indirect = Indirect::kSplit;
      break;
  }
  return plan;
}

// Photons come from lights alone. What media emit is found by paths, so without lights nothing is left for
// photons.
void leave_emission_to_paths(const RenderSettings& settings, const SceneNeeds& needs, EstimatorPlan* plan) {
  if (!needs.emissive_media) return;
  plan->notes.emplace_back("media emit light: paths find it, since photons come from lights alone");
  if (needs.any_light) return;
  if (!settings.direct) plan->direct = Direct::kShadowRays;
  if (reads_caustic_photons(*plan) && !settings.caustics) plan->caustics = Caustic::kPaths;
  if (reads_indirect_photons(*plan) && !settings.indirect) plan->indirect = Indirect::kPaths;
}

void leave_out(const RenderSettings& settings, const SceneNeeds& needs, EstimatorPlan* plan) {
  const bool lit = needs.any_light || needs.emissive_media;
  if (!lit) plan->notes.push_back("no light: the image is black");
  // Caustics are the only class that may be empty by construction: without specular surfaces, light, or
  // surfaces that receive it.
  const bool scattered = needs.diffuse || needs.scattering;
  const bool received = scattered || plan->glossy_tails;
  const bool empty = !needs.specular || !lit || !received;
  if (empty && plan->caustics != Caustic::kOff && !settings.caustics) {
    plan->caustics = Caustic::kOff;
    plan->notes.push_back(
        !needs.specular
            ? "no specular surface: no caustic pass; saves the caustic map and a query at each point"
        : !lit ? "no light: no caustic pass"
               : "no diffuse surface: no caustic pass");
  }
  if ((!lit || !scattered) && plan->indirect != Indirect::kOff && !settings.indirect) {
    plan->indirect = Indirect::kOff;
    plan->notes.push_back(!lit ? "no light: no indirect light" : "no diffuse surface: no indirect light");
  }
}

// Media follow the estimators of surfaces.
void choose_for_media(const SceneNeeds& needs, EstimatorPlan* plan) {
  if (!needs.scattering) return;
  // Light in media is not divided. Paths take less time to the same error, as gathers along rays are dear;
  // but they lack caustics of lights that no ray can hit.
  if (plan->caustics == Caustic::kSplit) plan->caustics = Caustic::kPhotons;
  if (plan->indirect == Indirect::kSplit)
    plan->indirect = needs.specular ? Indirect::kPhotons : Indirect::kPaths;
  plan->medium_caustics = plan->caustics == Caustic::kPhotons;
  plan->medium_indirect = reads_indirect_photons(*plan);
  plan->notes.push_back(
      plan->medium_indirect
          ? "media scatter light: single scattering comes from light samples along rays, all "
            "else from photons in the media"
          : "media scatter light: paths are scattered in them");
}

// Whether photons can tell what light the paths that look for indirect light would find. They pass no media,
// and what media emit leaves no photons.
bool may_end_paths(const SceneNeeds& needs, Indirect indirect) {
  return (indirect == Indirect::kPaths || indirect == Indirect::kSplit) && !needs.media && needs.any_light;
}

void note_photon_kinds(const EstimatorPlan& plan, std::vector<std::string>* notes) {
  const photon::KindMask kinds = kinds_needed(plan);
  if (plan.direct == Direct::kPredicted)
    notes->push_back(
        "direct and shadow photons are counted but not stored: they predict which lights are visible; "
        "saves most shadow rays");
  if (!kinds.any()) {
    notes->push_back("no estimator uses stored photons: no photon pass; saves tracing and storing photons");
    return;
  }
  if (!kinds.shadow && plan.direct != Direct::kPredicted)
    notes->push_back(
        "shadow photons are not traced: the direct estimator does not use them; saves a ray and a record "
        "for each surface behind the first one that a direct photon meets");
  if (plan.direct == Direct::kShadowRays)
    notes->push_back(
        "direct photons are not stored: direct light comes from shadow rays; saves a record per photon");
  if (plan.direct == Direct::kSigned)
    notes->push_back(
        "direct photons are not stored: only the flux of shadow photons is subtracted; saves a record per "
        "photon");
  if (!kinds.indirect)
    notes->push_back(std::string("indirect photons are not traced: indirect light ") +
                     (plan.indirect == Indirect::kPaths ? "comes from paths" : "is off") +
                     "; saves each photon's path after its first diffuse surface");
}

void note_limits(const SceneNeeds& needs, EstimatorPlan* plan) {
  if (!needs.specular || !needs.any_light) return;
  if (plan->caustics == Caustic::kPaths && needs.only_delta_lights && needs.delta)
    plan->notes.push_back(
        "paths cannot hit point, spot or distant lights: their caustics are missing; use --caustics photons");
  if (plan->caustics == Caustic::kOff && plan->indirect == Indirect::kPaths && needs.only_delta_lights &&
      needs.delta)
    plan->notes.push_back(
        "caustics are off: light from point, spot or distant lights through specular surfaces is missing "
        "from the indirect light too");
  if (plan->caustics == Caustic::kOff && needs.diffuse)
    plan->notes.push_back(
        "caustics are off: light that reaches diffuse surfaces by way of mirrors or glass is left out");
}

}  // namespace

EstimatorPlan make_plan(const RenderSettings& settings, const SceneNeeds& needs) {
  EstimatorPlan plan = preset(settings.method, needs);
  // The bias of discs can be stated where photons carry all.
  if (settings.method == Method::kAuto && settings.estimate_bias.value_or(false))
    plan.caustics = Caustic::kPhotons, plan.indirect = Indirect::kPhotons;
  if (settings.direct) plan.direct = *settings.direct;
  if (settings.caustics) plan.caustics = *settings.caustics;
  if (settings.indirect) plan.indirect = *settings.indirect;
  plan.glossy_tails =
      settings.method == Method::kAuto && reads_caustic_photons(plan) && needs.glossy && needs.any_light;
  leave_emission_to_paths(settings, needs, &plan);
  leave_out(settings, needs, &plan);
  choose_for_media(needs, &plan);
  plan.ends_paths = settings.final_gather.value_or(false) && may_end_paths(needs, plan.indirect);
  plan.notes.insert(plan.notes.begin(),
                    fmt::format("method {}: direct {}, caustics {}, indirect {}", name_of(settings.method),
                                name_of(plan.direct), name_of(plan.caustics), name_of(plan.indirect)));
  if (plan.ends_paths)
    plan.notes.push_back(
        "paths end where few photons tell what light arrives: saves most of their length and noise "
        "(--final-gather off: they go on)");
  note_photon_kinds(plan, &plan.notes);
  note_limits(needs, &plan);
  return plan;
}

photon::KindMask kinds_needed(const EstimatorPlan& plan) {
  photon::KindMask kinds;
  kinds.direct = plan.direct == DirectEstimator::kPhotons || plan.direct == DirectEstimator::kLecture;
  kinds.shadow = plan.direct == DirectEstimator::kLecture || plan.direct == DirectEstimator::kSigned;
  kinds.caustic = reads_caustic_photons(plan);
  kinds.indirect = reads_indirect_photons(plan);
  kinds.medium_caustic = plan.medium_caustics;
  kinds.medium_indirect = plan.medium_indirect;
  return kinds;
}

}  // namespace kaustik::render
