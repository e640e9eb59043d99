#pragma once
// The shoots of one pass: which photons are emitted for the plan, and what guides them.

#include <memory>

#include "photon/shoot/guide_shoot.h"
#include "photon/shoot/shoot.h"
#include "render/plan/pass_share.h"
#include "render/plan/progress.h"
#include "render/plan/render_input.h"
#include "render/statistics/statistics.h"

namespace kaustik::render {

// Guides of caustic and of indirect photons; null where the plan does not need them or nothing may be guided.
// A function of scene and settings, so the same for all passes.
struct PhotonGuides {
  std::unique_ptr<const photon::LearnedGuide> caustic, indirect;
};

// The tracer's settings for a pass. Only the kinds that the plan needs are traced.
photon::TraceSettings trace_settings(const RenderSettings& settings, const EstimatorPlan& plan,
                                     const PassShare& pass);

// Number of photons of a guided caustic shoot in a pass of `photons` photons, or 0 if nothing may be guided.
// All of them if the plan needs no other kind; otherwise half as many again, besides the photons of the other
// kinds. Guided photons cost a few rays each, and reduce the picture's error about as much in the same time
// as more samples would.
uint64_t guided_photons(const RenderSettings& settings, const EstimatorPlan& plan, uint64_t photons);

// Learns the guides that the plan needs and that are not there yet. Adds to the photons' seconds, and sets
// the guide fields of statistics.
void learn_guides(const RenderInput& input, PhotonGuides* guides, RenderStatistics* statistics);

// Shoots the photons that the plan needs. Adds to the photon fields of statistics. False when the progress
// callback cancelled.
bool shoot_kinds(const RenderInput& input, const PassShare& pass, const PhotonGuides& guides,
                 const ProgressCallback& progress, photon::ShootResult* shot, RenderStatistics* statistics);

}  // namespace kaustik::render
