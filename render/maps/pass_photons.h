#pragma once
// Makes the photon maps of successive passes, and keeps what all passes of a process share.

#include <memory>
#include <optional>
#include <vector>

#include "accel/edge_index.h"
#include "photon/visibility/visibility_tree.h"
#include "render/explore/sky_guide.h"
#include "render/maps/gather_radii.h"
#include "render/maps/kept_photons.h"
#include "render/maps/photon_maps.h"
#include "render/maps/photon_shoots.h"

namespace kaustik::render {

// The feet of walls (accel/wall_feet.h).
struct WallFeet {
  float gap = 0;  // metres; walls that end so high above a surface are among them
  std::vector<BoundaryEdge> edges;
};

// Facts about the scene that do not depend on the photons, found once. Only the feet of walls depend on the
// radius of the first pass. Members are null until they are needed. The estimates of maps point to them.
struct ExploredScene {
  std::unique_ptr<const accel::EdgeIndex> edges;  // edges of surfaces
  std::vector<SurfaceBend> bends;                 // bend of surfaces, by surface group; set with edges
  std::optional<WallFeet> feet;
  std::unique_ptr<const SkyGuide> sky;
  // What few photons told about those of a render with these settings, for the first pass to take.
  std::unique_ptr<PhotonGuides> guides;
  double seconds = 0;  // spent in PassPhotons::explore()
};

class PassPhotons {
 public:
  PassPhotons() = default;
  // radii: r0 of all passes, if known. explored: what is known about the scene already.
  PassPhotons(const std::optional<GatherRadii>& radii, std::shared_ptr<ExploredScene> explored)
      : radii_(radii), explored_(std::move(explored)) {}
  explicit PassPhotons(std::shared_ptr<ExploredScene> explored) : explored_(std::move(explored)) {}

  // Shoots and builds the photons that the plan needs in one pass, replacing the maps of the previous pass.
  // If r0 is not known yet, it is determined from these maps, that is by the first pass. Adds to the photon
  // fields of statistics. False when the progress callback cancelled. The maps are a function of scene,
  // settings (except the number of samples), plan, pass and radii only, whatever the number of threads.
  bool make(const RenderInput& input, const PassShare& pass, const ProgressCallback& progress,
            RenderStatistics* statistics);

  // Takes photons that were shot before, in place of make(). They must be what make() would shoot for the
  // only pass, and have the same bits then. radii_known: whether their r0 is that of the settings; if not, it
  // is chosen from these maps. Adds the counts of the photons to statistics.
  void adopt(const RenderInput& input, KeptPhotons&& kept, bool radii_known, RenderStatistics* statistics);

  // Finds what make() needs to know about the scene and does not know yet, except the feet of walls. False
  // when the progress callback cancelled.
  bool explore(const RenderInput& input, const ProgressCallback& progress = {});
  // Makes the visibility tree for `predicted`, unless it exists. It depends on scene and settings but not on
  // the pass; whatever it predicts, the image is unbiased. Its time is added to that of the photons.
  void predict_visibility(const RenderInput& input, RenderStatistics* statistics);
  // Learns where paths end, if the plan lets them, unless that is known already. It depends on scene and
  // settings but not on the pass. Call it after make() or adopt(). Its time is added to that of the photons.
  // False when the progress callback cancelled.
  bool end_paths(const RenderInput& input, const ProgressCallback& progress, RenderStatistics* statistics);
  // Learns where the sky is visible for method `auto`, unless that is known already. A function of scene and
  // settings; whatever it learns, the image is unbiased.
  void learn_sky(const RenderInput& input, RenderStatistics* statistics);
  // Determines r0 from the present maps, as if they were the first, and what follows from it.
  void choose_radii_anew(const RenderInput& input, const PassShare& pass);
  // Tells that these photons are a trial, and that a render of more photons, with smaller discs, follows: it
  // shall find the feet of walls known.
  void mark_as_trial() { is_trial_ = true; }
  // The tree depends on the number of samples: call this before they change.
  void forget_visibility() { visibility_.reset(); }

  // The present maps, which make() has built for the only pass. They share the photons with this object.
  KeptPhotons keep(const RenderStatistics& statistics) const;

  // Valid until the next make().
  const PhotonMaps& maps() const { return maps_; }
  // Null: nothing is predicted.
  const photon::VisibilityTree* visibility() const { return visibility_.get(); }
  // Null: samples of skies are not guided.
  const SkyGuide* sky() const {
    return explored_->sky && explored_->sky->useful() ? explored_->sky.get() : nullptr;
  }
  // What was found out about the scene. Depends on the scene and on settings other than the numbers of
  // photons and samples.
  const std::shared_ptr<ExploredScene>& explored() const { return explored_; }
  // r0 of the first pass; empty until it is known, and if the plan needs no photons.
  const std::optional<GatherRadii>& radii() const { return radii_; }

 private:
  void build_maps(const RenderInput& input, photon::ShootResult&& shot);
  void free_maps();
  void forget_radii_and_walls();
  void prepare_gathers(const RenderInput& input, const PassShare& pass);
  void find_walls(const Scene& scene);
  void set_estimates(const RenderInput& input, const PassShare& pass);
  void set_areas(const Scene& scene);
  void set_clearance(const RenderInput& input, const PassShare& pass);
  void set_discs(const RenderSettings& settings, const PassShare& pass);
  std::shared_ptr<const photon::SurfaceAreas> areas_for(float radius, const Scene& scene) const;

  // State of the current pass.
  PhotonMaps maps_;

  // State shared by all passes.
  std::optional<GatherRadii> radii_;
  RadiusShrink shrink_;
  std::shared_ptr<ExploredScene> explored_ = std::make_shared<ExploredScene>();
  std::unique_ptr<const photon::Walls> walls_;  // null: none, or not looked for yet
  std::unique_ptr<const PathEnds> ends_;
  bool walls_are_known_ = false;
  bool is_trial_ = false;
  PhotonGuides guides_;
  std::unique_ptr<const photon::VisibilityTree> visibility_;
};

// Photons of the first pass, shot in advance, with their statistics.
struct FirstPhotons {
  PassPhotons photons;
  RenderStatistics statistics;
};

}  // namespace kaustik::render
