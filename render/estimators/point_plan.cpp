// Chooses between a disc of the indirect map and a final gather.

#include "render/estimators/point_plan.h"

#include "render/explore/surroundings.h"

namespace kaustik::render {

namespace {

// Least share of the indirect map's disc that must lie on the surface: that of a disc in a corner, where
// three walls meet. On narrow surfaces the correction for the missing share is a guess, which may be wrong by
// half.
constexpr double kLeastSupport = 0.2;
constexpr float kErrorOfGuess = 0.5f;

// Relative error of a disc of radius r at a place of clearance c. The second derivative of the irradiance is
// about 1 / (2 c)^2 of it, and the second-order term of its mean over the disc is r^2 / 8 times that:
// r^2 / (32 c^2). Where the clearance is unknown, c = r.
float error_of_disc(float radius, float clearance) {
  const float ratio = clearance > 0 ? radius / clearance : 1;
  return std::min(ratio * ratio / 32, kErrorOfGuess);
}

// Relative error of a disc whose correction is this factor: where discs are wrong by much, their error varies
// as much within a cell of the correction.
float error_of_correction(const Rgb& factor) {
  const float f = luminance(factor);
  return std::abs(f - 1) / std::max(f, 1.0f);
}

// Whether a disc at x is a better estimate than a final gather. blurred: the point is seen through a glossy
// lobe that is wider than the disc, so that only the disc's support matters. share() gives the share of the
// disc on the surface; it takes long, and often does not matter.
template <class Share>
bool disc_is_better(const RenderContext& ctx, const ShadingPoint& x, bool blurred, const Share& share) {
  const Normal3 n = glm::dot(x.wo, x.si.n) < 0 ? -x.si.n : x.si.n;
  const Place place = ctx.maps.surroundings->at(x.si.p, n);
  const float error_of_path = place.noise / std::sqrt(float(ctx.settings.spp));
  if (error_of_path >= kErrorOfGuess) return true;
  const float radius = ctx.maps.indirect.estimate.radius;
  if (error_of_correction(disc_factor(ctx, x)) > error_of_path) return false;
  const float clearance = std::min(place.clearance, place.lit_clearance);
  if (!blurred && error_of_disc(radius, clearance) > error_of_path) return false;
  return share() >= kLeastSupport;
}

}  // namespace

bool takes_disc(const RenderContext& ctx, const ShadingPoint& x, bool blurred, photon::EstimateBatch* batch) {
  const photon::EstimateSettings& estimate = ctx.maps.indirect.estimate;
  if (!ctx.maps.surroundings) return true;  // without photons, nothing is gathered
  if (estimate.leaf) return disc_is_better(ctx, x, blurred, [] { return 1.0; });
  const auto disc = batch->disc(ctx.maps.indirect.map, x.si, x.wo, *x.bsdf, estimate);
  const uint8_t taken = blurred ? 1 : 2, refused = blurred ? 4 : 8;
  uint8_t& note = batch->note(disc);
  if (!(note & (taken | refused))) {
    const auto share = [&] { return batch->share(disc, estimate); };
    note |= disc_is_better(ctx, x, blurred, share) ? taken : refused;
  }
  return note & taken;
}

}  // namespace kaustik::render
