#pragma once
// The photon maps of one pass: which kinds are needed, the shoot, the builds, the gather radii.

#include <memory>
#include <optional>

#include "accel/edge_index.h"
#include "photon/estimate/radiance_estimate.h"
#include "photon/estimate/shadow_classifier.h"
#include "photon/map/photon_map.h"
#include "photon/shoot/guide_shoot.h"
#include "photon/shoot/shoot.h"
#include "photon/visibility/visibility_tree.h"
#include "render/passes/passes.h"
#include "render/renderer.h"

namespace kaustik::render {

// A map and how it is read.
struct ReadMap {
  photon::PhotonMap map;
  photon::EstimateSettings estimate;
  std::shared_ptr<const photon::SurfaceAreas> areas;  // estimate points to it where it serves
};

struct PhotonMaps {
  ReadMap direct, caustic, indirect;
  photon::PhotonMap shadow;  // for `lecture`, and for `signed`, which reads it with direct.estimate
  photon::LectureSettings lecture;
  RadiusShrink shrink;
  std::unique_ptr<const accel::EdgeIndex> edges;             // where surfaces end; the estimates point to it
  std::vector<SurfaceBend> bends;                            // how they curve, by surface group
  std::unique_ptr<const photon::VisibilityTree> visibility;  // only for `predicted`; of all passes
  // For caustic and indirect photons that are read; of all passes.
  std::unique_ptr<const photon::LearnedGuide> caustic_guide, indirect_guide;
};

// The kinds that the plan's estimators read; only these are traced and stored.
photon::KindMask kinds_needed(const EstimatorPlan& plan);

// Of so many photons of a pass: emitted for caustics alone where that is guided. As many where the plan reads
// no other kind, else half, beside the others: they cost a few rays each, and lower the picture's error about
// as much for their time as more samples would. 0 where nothing may be guided.
uint64_t guided_photons(const RenderSettings& settings, const EstimatorPlan& plan, uint64_t photons);

// Which lights are seen from where, for `predicted`, unless it is there. Of scene and settings, not of the
// pass: whatever is predicted, the image is right on average. Adds to the photons' seconds.
void predict_visibility(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                        const EstimatorPlan& plan, PhotonMaps* maps, RenderStatistics* statistics);

// Shoots and builds what the plan reads in one pass, in place of the maps of the pass before. radii: r0 of
// all passes, settled from these maps where it is empty, so by the first pass. Adds to the photon fields of
// statistics. False when progress cancelled. The result is a function of scene, settings (but for the number
// of samples), plan, pass and radii only, whatever the number of threads.
bool make_photon_maps(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                      const EstimatorPlan& plan, const PassShare& pass, const ProgressCallback& progress,
                      PhotonMaps* maps, std::optional<GatherRadii>* radii, RenderStatistics* statistics);

}  // namespace kaustik::render
