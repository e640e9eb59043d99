#include "render/maps/disc_error.h"

#include <algorithm>
#include <cmath>

#include "core/parallel/parallel.h"
#include "core/sampling/warp.h"
#include "render/maps/radius.h"

namespace kaustik::render {

namespace {

// Separates the random numbers of these rays from all others.
constexpr uint64_t kClearanceStream = 0xC1EA;
constexpr int kRaysEach = 16;

// Harmonic mean of the distances to other surfaces, weighted by the cosine at x: the irradiance varies over
// distances of about that (Ward, Rubinstein and Clear 1988).
double clearance_at(const RenderInput& input, const VisiblePoint& x, Sampler& sampler) {
  const Frame frame = Frame::from_z(x.query.n);
  double inverse = 0;
  for (int i = 0; i < kRaysEach; ++i) {
    const Vector3 wi = frame.to_world(sample_cosine_hemisphere(sampler.next_2d()));
    if (!(glm::dot(wi, x.query.n) > 0)) continue;
    const Hit hit = input.bvh.intersect(x.si.spawn(wi));
    if (hit.valid() && hit.t > 0) inverse += 1 / double(hit.t);
  }
  return inverse > 0 ? kRaysEach / inverse : HUGE_VAL;
}

// Relative error of a disc of radius r at a place of clearance c. The second derivative of the irradiance is
// about 1 / (2 c)^2 of it, and the second-order term of its mean over the disc is r^2 / 8 times that:
// r^2 / (32 c^2). Where surfaces are so near that this says little, half of the light may be wrong.
double error_of_disc(double radius, double clearance) {
  constexpr double kMost = 0.5;
  const double ratio = radius / clearance;
  return std::min(ratio * ratio / 32, kMost);
}

}  // namespace

DiscError::DiscError(const RenderInput& input, const std::vector<VisiblePoint>& points,
                     const photon::IrradianceTree& pilot, double photons, double each)
    : photons_(photons), each_(each) {
  constexpr size_t kOneIn = 4;
  places_.resize((points.size() + kOneIn - 1) / kOneIn);
  parallel::for_index(size_t{0}, places_.size(), [&](size_t i) {
    Sampler sampler(hash_combine(input.settings.seed, kClearanceStream), i);
    const VisiblePoint& x = points[kOneIn * i];
    places_[i] = {pilot.at(x.query.p, x.query.n).density(), clearance_at(input, x, sampler)};
  });
}

double DiscError::of(double share) const {
  const double reach = photons_in_reach_of_indirect(share * photons_);
  return 1 / reach + bias(share * each_, reach);
}

double DiscError::bias(double each, double reach) const {
  double sum = 0;
  for (const Place& place : places_) {
    const double density = each * place.density;
    const double radius = density > 0 ? std::sqrt(reach / (double(kPi) * density)) : HUGE_VAL;
    const double error = error_of_disc(radius, place.clearance);
    sum += std::isnan(error) ? 0 : error * error;
  }
  return places_.empty() ? 0 : sum / double(places_.size());
}

}  // namespace kaustik::render
