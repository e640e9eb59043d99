#pragma once
// Radii of gathers by how far other surfaces are.
//
// Indirect irradiance varies over distances of about the clearance c of a place, the harmonic mean of the
// distances to other surfaces, so that the bias of a disc of radius r goes like r^2 / c^2 (Ward, Rubinstein
// and Clear 1988, "A Ray Tracing Solution for Diffuse Interreflection"). With n photons per area its relative
// variance is 1 / (n pi r^2). The sum of that and of the squared bias is least for r ~ c^(2/3). The radius
// depends on surfaces alone, not on photons, so it does not bias the estimate by their chance.

#include <array>

#include "accel/bvh.h"
#include "core/geometry/interaction.h"

namespace kaustik::photon {

// Immutable; thread-safe. Keeps a reference to the Bvh.
class ClearRadius {
 public:
  // widest: the largest radius in metres. photons: how many lie in such a disc where they are of usual
  // density; > 0.
  ClearRadius(const accel::Bvh& bvh, float widest, double photons);

  // The radius of a disc about si on the side of n. Exact under scaling of the scene by powers of two.
  float at(const SurfaceInteraction& si, const Normal3& n) const;

 private:
  static constexpr size_t kRays = 16;

  const accel::Bvh& bvh_;
  float widest_;
  float clear_;  // from this clearance on discs are the widest
  std::array<Vector3, kRays> directions_;
};

}  // namespace kaustik::photon
