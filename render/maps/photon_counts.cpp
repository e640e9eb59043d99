// Divides the time for photons between the kinds so that the sum of their errors is least.
//
// Of M photons of a kind that are seen, some M^(2/3) are in reach of a gather (render/maps/radius.h). If the
// kind brings the share s of a place's light, its error there has the relative variance s^2 / M^(2/3). With y
// photons seen and r rays traced for each that is emitted, the sum over the kinds of  s^2 / (y E)^(2/3) + c r
// E is least for  E ~ (s^2 / (y^(2/3) r))^(3/5),  where c is the worth of a ray.

#include "render/maps/photon_counts.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "render/explore/place_grid.h"
#include "render/maps/pilot_photons.h"

namespace kaustik::render {

namespace {

using photon::PhotonKind;

constexpr uint64_t kCountPass = 0x636f756e74000000, kCountPhotons = 1u << 14;
// The relative squared error of caustics, as a multiple of that of indirect light from as many photons: their
// discs hold fewer photons, as they are sharper, and what is seen of them is bright.
constexpr double kErrorOfCaustics = 4;
// Multiple of RenderSettings::photons that is emitted where the kind brings all light and each photon is seen
// and takes one ray.
constexpr double kOfSimplest = 2;
// Limits, as multiples of RenderSettings::photons: of the photons to emit, and of all rays.
constexpr double kFewestEmitted = 1.0 / 16, kMostRays = 4;
// From this many photons on that the pilot sees, their share of the light is trusted.
constexpr double kTrusted = 16;

// The light that photons bring to a place.
struct Light {
  double of_kind = 0, of_others = 0;
};

double brightness(const Rgb& flux) {
  return double(flux.x) + double(flux.y) + double(flux.z);
}

// The light of the pilot's photons where visible points are.
class SeenLight {
 public:
  SeenLight(const std::vector<VisiblePoint>& points, const PilotPhotons& pilot, PhotonKind kind)
      : points_(points), grid_(points, 32) {
    for (const VisiblePoint& point : points) places_[key(point)];
    for (const auto& [photon, of, index] : pilot.left) {
      const auto place = places_.find(grid_.key(photon.p, photon.n));
      if (place == places_.end()) continue;
      (of == kind ? place->second.of_kind : place->second.of_others) += brightness(photon.flux);
      photons_ += of == kind;
    }
  }
  double photons() const { return double(photons_); }
  // The mean square of the kind's share of the light at a visible point.
  double squared_share() const {
    double sum = 0, lit = 0;
    for (const VisiblePoint& point : points_) {
      const Light light = places_.at(key(point));
      const double all = light.of_kind + light.of_others;
      if (!(all > 0)) continue;
      ++lit;
      sum += light.of_kind * light.of_kind / (all * all);
    }
    return lit > 0 ? sum / lit : 1;
  }

 private:
  uint64_t key(const VisiblePoint& point) const { return grid_.key(point.query.p, point.query.n); }

  const std::vector<VisiblePoint>& points_;
  PlaceGrid grid_;
  std::unordered_map<uint64_t, Light> places_;
  uint64_t photons_ = 0;
};

}  // namespace

PhotonNeed photons_needed(const RenderInput& input, const std::vector<VisiblePoint>& points,
                          photon::TraceSettings trace, PhotonKind kind) {
  trace.pass = kCountPass + uint64_t(kind);
  trace.photons = kCountPhotons;
  const auto each = [](double of_pilot) { return of_pilot / double(kCountPhotons); };
  const photon::TraceCounters shot = shoot_pilot(input, trace).counters;
  const double rays = std::max(each(double(shot.rays)), 1e-3);
  const double stored = each(double(shot.stored[size_t(kind)]));
  trace.kinds = {.direct = true, .caustic = true, .indirect = true};
  const SeenLight seen(points, shoot_pilot(input, trace), kind);
  const double trust = std::clamp((seen.photons() - 1) / kTrusted, 0.0, 1.0);
  const double error = trust * seen.squared_share() * (kind == PhotonKind::kCaustic ? kErrorOfCaustics : 1);
  const double root = std::cbrt(std::max(each(seen.photons()), 1e-9));
  const double worth = kOfSimplest * std::pow(error / (root * root * rays), 0.6);
  return {std::min(worth, PhotonCounts::kMostStored / std::max(stored, 1e-9)), rays};
}

PhotonCounts within_limits(const PhotonNeed& caustic, const PhotonNeed& indirect, bool together) {
  const double of_caustic = caustic.rays * caustic.emitted, of_indirect = indirect.rays * indirect.emitted;
  const double all = together ? std::max(of_caustic, of_indirect) : of_caustic + of_indirect;
  const double fits = std::min(kMostRays / std::max(all, 1e-9), 1.0);
  const auto limited = [&](const PhotonNeed& need) {
    return need.rays > 0 ? std::clamp(fits * need.emitted, kFewestEmitted, PhotonCounts::kMost) : 0;
  };
  return {limited(caustic), limited(indirect)};
}

}  // namespace kaustik::render
