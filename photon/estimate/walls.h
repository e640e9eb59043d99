#pragma once
// Walls that stand on a surface cut the discs of density estimates.
//
// A photon behind a wall says nothing about the light in front of it. Near a wall, a photon y counts at x
// only if the straight line from x to y, both projected to the tangent plane at x, crosses no wall's foot
// (accel/wall_feet.h). The area behind the walls, as seen from x, then no longer belongs to the disc: the
// kernel's mass in front of them,
//
//   S = 1/(2 pi) * integral over theta of C(rho_w(theta)),   C(rho) = share of the mass within rho,
//
// where rho_w is the distance of the first foot in direction theta (at most the radius), less the mass beyond
// the edges of the surface that are in front of the foot (photon/estimate/boundary_correction.h). The
// integral is a sum over kDirections directions: each end of a foot may move it by 1/(2 kDirections).
//
// x and y are taken a few rounding errors towards where they were seen from, so that points at a foot are on
// the side from which light or sight reached them.

#include <cstdint>
#include <vector>

#include "accel/edge_index.h"
#include "core/geometry/interaction.h"
#include "core/math/bounds.h"
#include "photon/estimate/line_fan.h"
#include "photon/gather/gather.h"

namespace kaustik::photon {

// The feet of all walls, and a grid that tells quickly that none is near. Immutable after construction; const
// members may be called from any thread.
class Walls {
 public:
  // radius: of the largest disc, metres. bounds: of the scene.
  Walls(std::vector<BoundaryEdge> feet, const Bounds3& bounds, float radius);

  // Whether a foot may be within radius() of p; true too often, never too rarely.
  bool near(const Point3& p) const {
    return marks_[cell_of(p, 0) * kCells + cell_of(p, 1)] >> cell_of(p, 2) & 1;
  }
  float radius() const { return radius_; }
  const accel::EdgeIndex& feet() const { return feet_; }

 private:
  static constexpr uint32_t kCells = 64;  // along each axis, so that a row along z is one word of marks_

  uint32_t cell_of(const Point3& p, int k) const {
    // NaN, and what is outside, goes to the border.
    const float at = (p[k] - origin_[k]) * cells_per_metre_[k];
    return at > 0 ? std::min(static_cast<uint32_t>(std::min(at, float(kCells))), kCells - 1) : 0;
  }
  void mark(const BoundaryEdge& foot);

  accel::EdgeIndex feet_;
  float radius_;
  Point3 origin_;
  Vector3 cells_per_metre_;
  std::vector<uint64_t> marks_;
};

// What the walls cut off from one disc.
class WallCut {
 public:
  // If more feet than this are within the disc, it is not cut.
  static constexpr size_t kMostFeet = 128;
  static constexpr int kDirections = 128;

  // The disc of `radius` metres, at most walls.radius(), at si, which is seen from the direction wo. n: the
  // side of the surface whose photons count.
  WallCut(const Walls& walls, const SurfaceInteraction& si, const Vector3& wo, const Normal3& n,
          float radius);

  // Whether any wall cuts the disc.
  bool cuts() const { return !feet_.empty(); }
  // Whether a point of the surface that is lit or seen from the direction w is behind a wall.
  bool hides(const Point3& p, const Vector3& w) const;
  // The mass of a kernel of `radius` metres, at most that of the constructor, in front of the walls and on
  // the surface, in [0, 1]. si: as constructed with. ends: where the surface ends.
  double share(const SurfaceInteraction& si, const KernelSpec& kernel, const accel::EdgeIndex& ends,
               float radius) const;

 private:
  struct Line {
    glm::dvec2 a, b;  // relative to x
  };
  glm::dvec2 flat(const glm::dvec3& from_x) const {
    return {glm::dot(from_x, glm::dvec3(frame_.x)), glm::dot(from_x, glm::dvec3(frame_.y))};
  }
  Line line_of(const BoundaryEdge& edge) const;

  Frame frame_;
  double step_;
  glm::dvec3 x_;
  std::vector<Line> feet_;
  LineFan<kMostFeet> fan_;  // of feet_
};

// gather_flux() without the photons that the walls hide.
Rgb gather_flux(const PhotonMap& map, const GatherQuery& query, const KernelSpec& kernel, const WallCut& cut,
                GatherCounters& counters);

}  // namespace kaustik::photon
