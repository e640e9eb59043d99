#pragma once
// The photon maps of one pass: which kinds are needed, the shoot, the builds, the gather radii.

#include <memory>
#include <optional>

#include "accel/edge_index.h"
#include "photon/photon_map.h"
#include "photon/radiance_estimate.h"
#include "photon/shadow_classifier.h"
#include "photon/shoot.h"
#include "photon/visibility_tree.h"
#include "render/passes.h"
#include "render/renderer.h"

namespace kaustik::render {

// A map and how it is read.
struct ReadMap {
  photon::PhotonMap map;
  photon::EstimateSettings estimate;
};

struct PhotonMaps {
  ReadMap direct, caustic, indirect;
  photon::PhotonMap shadow;  // for `lecture`, and for `signed`, which reads it with direct.estimate
  photon::LectureSettings lecture;
  RadiusShrink shrink;
  std::unique_ptr<const accel::EdgeIndex> edges;             // where surfaces end; the estimates point to it
  std::unique_ptr<const photon::VisibilityTree> visibility;  // only for `predicted`; of all passes
};

// The kinds that the plan's estimators read; only these are traced and stored.
photon::KindMask kinds_needed(const EstimatorPlan& plan);

// Shoots and builds what the plan reads in one pass, in place of the maps of the pass before. radii: r0 of
// all passes, settled from these maps where it is empty, so by the first pass. Adds to the photon fields of
// statistics. False when progress cancelled. The result is a function of scene, settings, plan, pass and
// radii only, whatever the number of threads.
bool make_photon_maps(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                      const EstimatorPlan& plan, const PassShare& pass, const ProgressCallback& progress,
                      PhotonMaps* maps, std::optional<GatherRadii>* radii, RenderStatistics* statistics);

}  // namespace kaustik::render
