#pragma once
// The photon maps of one pass: the kinds needed, the shoot, the builds and the gather radii.

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

// A map and the settings with which it is gathered.
struct GatherMap {
  photon::PhotonMap map;
  photon::EstimateSettings estimate;
  std::shared_ptr<const photon::SurfaceAreas> areas;  // keeps alive what estimate.areas points to
};

struct PhotonMaps {
  GatherMap direct, caustic, indirect;
  photon::PhotonMap shadow;  // for `lecture`, and for `signed`, which gathers it with direct.estimate
  photon::LectureSettings lecture;
  RadiusShrink shrink;
  std::unique_ptr<const accel::EdgeIndex> edges;             // edges of surfaces; the estimates point to it
  std::vector<SurfaceBend> bends;                            // bend of surfaces, by surface group
  std::unique_ptr<const photon::VisibilityTree> visibility;  // only for `predicted`; the same for all passes
  // Guides of caustic and indirect photons, if the plan needs these; the same for all passes.
  std::unique_ptr<const photon::LearnedGuide> caustic_guide, indirect_guide;
};

// Photon kinds that the plan's estimators use; only these are traced and stored.
photon::KindMask kinds_needed(const EstimatorPlan& plan);

// Number of photons of a guided caustic shoot in a pass of `photons` photons, or 0 if nothing may be guided.
// As many if the plan needs no other kind, otherwise half, in addition to the others: they cost a few rays
// each, and reduce the picture's error about as much in the same time as more samples would.
uint64_t guided_photons(const RenderSettings& settings, const EstimatorPlan& plan, uint64_t photons);

// Makes maps->visibility for `predicted`, unless it exists. It depends on scene and settings but not on the
// pass; whatever it predicts, the image is unbiased. Its time is added to that of the photons.
void predict_visibility(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                        const EstimatorPlan& plan, PhotonMaps* maps, RenderStatistics* statistics);

// Shoots and builds the photons that the plan needs in one pass, replacing the maps of the previous pass.
// radii: r0 of all passes; if empty, it is determined from these maps, that is by the first pass. Adds to the
// photon fields of statistics. False when the progress callback cancelled. The result is a function of scene,
// settings (except the number of samples), plan, pass and radii only, whatever the number of threads.
bool make_photon_maps(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                      const EstimatorPlan& plan, const PassShare& pass, const ProgressCallback& progress,
                      PhotonMaps* maps, std::optional<GatherRadii>* radii, RenderStatistics* statistics);

}  // namespace kaustik::render
