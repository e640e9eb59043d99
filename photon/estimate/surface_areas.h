#pragma once
// How much of a gather disc lies on a surface that curves.
//
// The disc of a density estimate is flat. On a ball smaller than the disc, on a wire or a fold, fewer photons
// are in reach than even light would bring to a plane, and the estimate is too dark by the share that is
// missing. Edges tell nothing of it (photon/estimate/boundary_correction.h): here that share is summed over
// the surface itself, as if each piece of it held one photon of the flux of its area. What counts is what
// counts for photons: the same group, a near normal, the same kernel.

#include <vector>

#include "core/geometry/boundary_edges.h"
#include "core/scene/scene.h"
#include "photon/map/photon_map.h"

namespace kaustik::photon {

// Immutable after construction; const members may be called from any thread.
class SurfaceAreas {
 public:
  // A radius beyond this part of a group's radius of curvature (the mean over its area) is worth the sum: of
  // a cylinder or ball all photons are in reach up to the whole of it.
  static constexpr double kFlat = 0.2;

  // Pieces per radius: some 450 in a disc, whose sum is within about one percent of the integral.
  static constexpr int kFineness = 12;

  // Groups of more pieces are not summed, nor what would make all of them more than kMostPieces.
  static constexpr uint64_t kMostPieces = 1 << 20;

  // For discs of up to `radius` metres on groups where photons are gathered; they bend by `bends`, one for
  // each group.
  SurfaceAreas(const Scene& scene, const std::vector<SurfaceBend>& bends, float radius);

  // Is share() known for the group?
  bool covers(uint32_t surface_group) const {
    return surface_group < covered_.size() && covered_[surface_group];
  }

  // Share of the kernel's mass on si's surface, in [kLeastShare, 1], as surface_share gives it where edges
  // tell it. radius: that of the constructor, or less: then of fewer pieces.
  double share(const SurfaceInteraction& si, const KernelSpec& kernel, float radius) const;

  float radius() const { return radius_; }  // metres, for discs of up to which it was made

 private:
  static constexpr double kLeastShare = 1.0 / 256;

  float radius_;
  std::vector<bool> covered_;
  PhotonMap pieces_;
};

}  // namespace kaustik::photon
