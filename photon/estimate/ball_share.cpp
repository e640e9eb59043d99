// The share of a gather disc on a ball; behind walls it is a sum over rings about the point.

#include "photon/estimate/ball_share.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "photon/estimate/boundary_correction.h"
#include "photon/estimate/walls.h"
#include "photon/record/packing.h"

namespace kaustik::photon {

namespace {

constexpr int kRings = 12, kSectors = 32;  // about as many pieces as SurfaceAreas has in a disc

// The share of the ring at the distance `chord` of si.p that no wall hides.
double share_in_front(const SurfaceInteraction& si, const Frame& frame, double ball_radius, double chord,
                      const WallCut& cut) {
  const double cosine = 1 - chord * chord / (2 * ball_radius * ball_radius);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const glm::dvec3 centre = glm::dvec3(si.p) - ball_radius * glm::dvec3(si.n);
  int seen = 0;
  for (int j = 0; j < kSectors; ++j) {
    const double phi = 2 * std::numbers::pi * (j + 0.5) / kSectors;
    const glm::dvec3 n = cosine * glm::dvec3(frame.z) +
                         sine * (std::cos(phi) * glm::dvec3(frame.x) + std::sin(phi) * glm::dvec3(frame.y));
    seen += !cut.hides(Point3(centre + ball_radius * n), Vector3(n));
  }
  return seen / double(kSectors);
}

}  // namespace

double share_on_ball(const SurfaceInteraction& si, float ball_radius, const KernelSpec& kernel, float radius,
                     const WallCut* cut) {
  const MassWithin mass_within(kernel);
  const double r = double(ball_radius);
  const double reach = std::min(std::abs(r) * std::sqrt(2 - 2 * double(kNormalCosine)), double(radius));
  if (!cut) return mass_within(reach / double(radius));
  const Frame frame = Frame::from_z(si.n);
  double sum = 0, inner = 0;
  for (int i = 0; i < kRings; ++i) {
    const double outer = mass_within(reach * (i + 1) / (kRings * double(radius)));
    sum += (outer - inner) * share_in_front(si, frame, r, reach * (i + 0.5) / kRings, *cut);
    inner = outer;
  }
  return sum;
}

}  // namespace kaustik::photon
