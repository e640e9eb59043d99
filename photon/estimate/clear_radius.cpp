#include "photon/estimate/clear_radius.h"

#include <cmath>

#include "core/math/frame.h"
#include "core/sampling/warp.h"

namespace kaustik::photon {

namespace {

// Discs are no narrower than this fraction of the widest: noise would show along the corners of rooms.
constexpr float kNarrowest = 0.375f;
// The bias of a disc, as a multiple of (r / c)^2. Measured on rooms, bare and with boxes: near corners, which
// cut discs, it is larger than Ward's 1 / 32 (docs/decisions/068-discs-follow-the-clearance.md).
constexpr double kBias = 0.7;

}  // namespace

// The least sum of 1 / (n pi r^2) and (b r^2 / c^2)^2 has r^6 = c^4 / (2 n pi b^2), which is the widest
// radius R for (c / R)^4 = 2 b^2 n pi R^2.
ClearRadius::ClearRadius(const accel::Bvh& bvh, float widest, double photons)
    : bvh_(bvh), widest_(widest), clear_(widest * float(std::sqrt(std::sqrt(2 * kBias * kBias * photons)))) {
  constexpr float kGolden = 0.618034f;  // turns from each direction to the next (Vogel 1979)
  for (size_t i = 0; i < kRays; ++i) {
    const float sin2 = (float(i) + 0.5f) / float(kRays), turns = float(i) * kGolden;
    const Point2 xy = std::sqrt(sin2) * cos_sin_turns(turns - std::floor(turns));
    directions_[i] = {xy.x, xy.y, std::sqrt(1 - sin2)};
  }
}

float ClearRadius::at(const SurfaceInteraction& si, const Normal3& n) const {
  const Frame frame = Frame::from_z(n);
  const float reach = 4 * clear_;
  float inverse = 0;
  for (const Vector3& direction : directions_) {
    const Hit hit = bvh_.intersect(si.spawn(frame.to_world(direction), reach));
    if (hit.valid() && hit.t > 0) inverse += clear_ / (float(kRays) * hit.t);
  }
  if (!(inverse > 1)) return widest_;
  const float root = std::cbrt(inverse);
  return widest_ * std::max(kNarrowest, 1 / (root * root));
}

}  // namespace kaustik::photon
