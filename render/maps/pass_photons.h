#pragma once
// Makes the photon maps of successive passes, and keeps what all passes of a process share.

#include <memory>
#include <optional>
#include <vector>

#include "accel/edge_index.h"
#include "photon/visibility/visibility_tree.h"
#include "render/maps/gather_radii.h"
#include "render/maps/photon_maps.h"
#include "render/maps/photon_shoots.h"
#include "render/maps/sky_guide.h"
#include "render/maps/surroundings.h"

namespace kaustik::render {

class PassPhotons {
 public:
  PassPhotons() = default;
  // radii: r0 of all passes, if known.
  explicit PassPhotons(const std::optional<GatherRadii>& radii) : radii_(radii) {}

  // Shoots and builds the photons that the plan needs in one pass, replacing the maps of the previous pass.
  // If r0 is not known yet, it is determined from these maps, that is by the first pass. Adds to the photon
  // fields of statistics. False when the progress callback cancelled. The maps are a function of scene,
  // settings (except the number of samples), plan, pass and radii only, whatever the number of threads.
  bool make(const RenderInput& input, const PassShare& pass, const ProgressCallback& progress,
            RenderStatistics* statistics);

  // Makes the visibility tree for `predicted`, unless it exists. It depends on scene and settings but not on
  // the pass; whatever it predicts, the image is unbiased. Its time is added to that of the photons.
  void predict_visibility(const RenderInput& input, RenderStatistics* statistics);
  // Learns where the sky is visible for method `auto`, unless that is known already. A function of scene and
  // settings; whatever it learns, the image is unbiased.
  void learn_sky(const RenderInput& input, RenderStatistics* statistics);
  // The tree depends on the number of samples: call this before they change.
  void forget_visibility() { visibility_.reset(); }

  // Valid until the next make().
  const PhotonMaps& maps() const { return maps_; }
  // Null: nothing is predicted.
  const photon::VisibilityTree* visibility() const { return visibility_.get(); }
  // Null: samples of skies are not guided.
  const SkyGuide* sky() const { return sky_.get(); }
  // r0 of the first pass; empty until it is known, and if the plan needs no photons.
  const std::optional<GatherRadii>& radii() const { return radii_; }

 private:
  void build_maps(const RenderInput& input, photon::ShootResult&& shot);
  void free_maps();
  void find_edges(const RenderInput& input);
  void find_walls(const RenderInput& input);
  void set_estimates(const RenderSettings& settings, const PassShare& pass);
  void set_areas(const Scene& scene);
  void find_surroundings(const RenderInput& input);
  std::shared_ptr<const photon::SurfaceAreas> areas_for(float radius, const Scene& scene) const;

  // State of the current pass.
  PhotonMaps maps_;

  // State shared by all passes.
  std::optional<GatherRadii> radii_;
  RadiusShrink shrink_;
  std::unique_ptr<const accel::EdgeIndex> edges_;  // edges of surfaces; the estimates point to it
  std::vector<SurfaceBend> bends_;                 // bend of surfaces, by surface group
  std::unique_ptr<const photon::Walls> walls_;     // null: none, or not looked for yet
  bool walls_are_known_ = false;
  PhotonGuides guides_;
  std::unique_ptr<const Surroundings> surroundings_;
  std::unique_ptr<const photon::VisibilityTree> visibility_;
  std::unique_ptr<const SkyGuide> sky_;  // null: not useful, or not looked for yet
  bool sky_is_known_ = false;
};

// Photons of the first pass, shot in advance, with their statistics.
struct FirstPhotons {
  PassPhotons photons;
  RenderStatistics statistics;
};

}  // namespace kaustik::render
