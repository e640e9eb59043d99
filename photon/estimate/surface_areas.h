#pragma once
// The share of a gather disc that lies on a curved surface.
//
// The disc of a density estimate is flat. On a ball smaller than the disc, on a wire or at a fold, fewer
// photons are in reach than even light would bring to a plane, and the estimate is too dark by the missing
// share. That share does not follow from edges (photon/estimate/boundary_correction.h). On a ball it has a
// closed form (photon/estimate/ball_share.h). Elsewhere it is summed over the surface itself, as if each
// piece held one photon whose flux is the piece's area. A piece counts under the same conditions as a photon:
// same group, near normal, same kernel.

#include <vector>

#include "core/geometry/boundary_edges.h"
#include "core/scene/scene.h"
#include "photon/gather/kernel.h"
#include "photon/map/photon_map.h"

namespace kaustik::photon {

class WallCut;

// Immutable after construction; const members may be called from any thread.
class SurfaceAreas {
 public:
  // A group is summed if the radius exceeds this fraction of the group's radius of curvature (the mean over
  // its area). On a cylinder or ball all photons within the disc are in reach up to the full radius of
  // curvature.
  static constexpr double kFlat = 0.2;

  // Pieces per radius: some 450 in a disc, whose sum is within about one percent of the integral.
  static constexpr int kFineness = 12;

  // Most pieces in all; groups that would exceed this number are not summed.
  static constexpr uint64_t kMostPieces = 1 << 20;

  // Prepares discs of up to `radius` metres on those groups where photons are gathered. bends: one for each
  // surface group.
  SurfaceAreas(const Scene& scene, const std::vector<SurfaceBend>& bends, float radius);

  // How many pieces there may be for any radius.
  static uint64_t most_pieces(const Scene& scene);

  // Whether share() is known for the group.
  bool covers(uint32_t surface_group) const {
    return surface_group < covered_.size() && covered_[surface_group];
  }
  // Whether it is so for discs of `radius` metres, too: smaller ones than half the radius of the constructor
  // hold too few pieces.
  bool covers(uint32_t surface_group, float radius) const {
    return radius >= 0.5f * radius_ && covers(surface_group);
  }

  // Share of the kernel's mass on si's surface, in [kLeastOfCurved, 1], as surface_share() computes it from
  // edges. radius: at most that of the constructor; smaller discs hold fewer pieces, so they are less
  // accurate.
  // cut: walls that hide pieces from si; may be null.
  double share(const SurfaceInteraction& si, const KernelSpec& kernel, float radius,
               const WallCut* cut = nullptr) const;

  float radius() const { return radius_; }  // metres; the largest disc that share() accepts

 private:
  // Less than kLeastShare, since the pieces of a thin wire are known as well as those of a wide tube.
  static constexpr double kLeastOfCurved = 1.0 / 256;

  float radius_;
  std::vector<bool> covered_;
  std::vector<float> balls_;  // by surface group: of a lone ball its radius as share_on_ball() takes it, or 0
  PhotonMap pieces_;
};

}  // namespace kaustik::photon
