#pragma once
// The shoots of one pass: which photons are emitted for the plan, and what guides them.

#include <memory>

#include "photon/shoot/guide_shoot.h"
#include "photon/shoot/memory_estimate.h"
#include "photon/shoot/shoot.h"
#include "render/maps/learn_split.h"
#include "render/maps/photon_counts.h"
#include "render/plan/pass_share.h"
#include "render/plan/progress.h"
#include "render/plan/render_input.h"
#include "render/statistics/statistics.h"

namespace kaustik::render {

// What few photons tell about those of all passes: a function of scene and settings.
struct PhotonGuides {
  // Null where the plan does not need them or nothing may be guided.
  std::unique_ptr<const photon::LearnedGuide> caustic, indirect;
  // The shares of photons, for plans that split sources.
  std::unique_ptr<const LearnedSplit> split;
  // How many photons to emit, where that follows what is seen of them.
  std::optional<PhotonCounts> counts;
  // TraceSettings::photons_on_segments; 0: not known yet.
  uint32_t photons_on_segments = 0;
};

// The tracer's settings for a pass. Only the kinds that the plan needs are traced.
photon::TraceSettings trace_settings(const RenderSettings& settings, const EstimatorPlan& plan,
                                     const PassShare& pass);

// Number of photons of a guided caustic shoot in a pass of `photons` photons, or 0 if nothing may be guided.
// All of them if the plan needs no other kind; otherwise half as many again, besides the photons of the other
// kinds. Guided photons cost a few rays each, and reduce the picture's error about as much in the same time
// as more samples would.
uint64_t guided_photons(const RenderSettings& settings, const EstimatorPlan& plan, uint64_t photons);
// What may be guided in such a pass, for the forecast of its memory.
photon::GuidedPhotons may_be_guided(const RenderSettings& settings, const EstimatorPlan& plan,
                                    uint64_t photons);

// Learns the shares of photons and paths, if the plan divides sources, and the guide of indirect photons
// where that needs it; nothing that is there already.
void learn_sources(const RenderInput& input, PhotonGuides* guides);

// Learns the guides that the plan needs and that are not there yet, after learn_sources(). Adds to the
// photons' seconds, and sets the guide fields of statistics.
void learn_guides(const RenderInput& input, PhotonGuides* guides, RenderStatistics* statistics);

// Chooses how many photons caustics leave on each segment in a medium, if the plan needs them and it is not
// known yet (photon::photons_on_segments). Adds to the photons' seconds.
void learn_segments(const RenderInput& input, PhotonGuides* guides, RenderStatistics* statistics);

// Shoots the photons that the plan needs. Adds to the photon fields of statistics. False when the progress
// callback cancelled.
bool shoot_kinds(const RenderInput& input, const PassShare& pass, const PhotonGuides& guides,
                 const ProgressCallback& progress, photon::ShootResult* shot, RenderStatistics* statistics);

}  // namespace kaustik::render
