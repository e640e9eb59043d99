// Automatic gather radii from distances to the k-th nearest photon.

#include "render/maps/radius.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/parallel/parallel.h"
#include "photon/estimate/beam_estimate.h"
#include "photon/gather/nearest.h"
#include "render/explore/pilot_beams.h"
#include "render/explore/visible_points.h"

namespace kaustik::render {

namespace {

constexpr uint32_t kPilotPoints = 1024;

// How many photons should be in reach. With M photons in a map, the variance of an estimate of radius r goes
// like 1 / (M r^2) and its squared bias like r^4. Their sum is smallest for r^2 ~ M^(-1/3), where k ~ M^(2/3)
// photons are in reach (Silverman 1986, section 4.3.1, in two dimensions).
struct RadiusRule {
  double of_million;  // k for M = 10^6
  double least;       // lower bound: with few photons in reach their noise shows, however small the map
};
// Measured (docs/decisions/031-gather-radius.md): direct light and caustics have edges, indirect light is
// smooth.
constexpr RadiusRule kDirectRule{160, 64};
constexpr RadiusRule kIndirectRule{500, 200};
constexpr RadiusRule kCausticRule{232, 24};
// Photons in reach of a ray through a medium; the kernel lies across the ray, so that the same rule holds.
constexpr RadiusRule kMediumIndirectRule{200, 64};
constexpr RadiusRule kMediumCausticRule{100, 32};
// Where direct photons are denser than at the median point by more than this, the radius shrinks: near a lamp
// their light is bright enough to show where a wider disc spreads it.
constexpr double kDirectDensity = 2;
// Factors for the median distance of caustics, for where they are sparse: where they are dense the photons'
// own discs are narrower, or the k-th nearest photon sets the radius.
constexpr float kCausticReach = 4, kMediumCausticReach = 2, kLeafReach = 2;

// Photons that divide the map's flux evenly, in the order of the map. (Guided photons are dense where they
// are dim.)
std::vector<VisiblePoint> photon_points(const photon::PhotonMap& map) {
  constexpr uint64_t kLookedAt = 1 << 16;
  const uint64_t looked_at = std::min(map.size(), kLookedAt);
  const auto photon = [&](uint64_t i) { return map.photon(i * map.size() / looked_at); };
  std::vector<double> light(looked_at);
  parallel::for_index(uint64_t{0}, looked_at,
                      [&](uint64_t i) { light[i] = double(max_component(photon(i).flux)); });
  std::partial_sum(light.begin(), light.end(), light.begin());
  std::vector<VisiblePoint> points;
  const uint64_t count = std::min<uint64_t>(looked_at, kPilotPoints);
  for (uint64_t i = 0; i < count; ++i) {
    const double at = light.back() * (double(i) + 0.5) / double(count);
    const auto found = std::lower_bound(light.begin(), light.end(), at);
    const photon::Photon p = photon(uint64_t(found - light.begin()));
    points.push_back({{p.p, p.n, p.surface_group}});
  }
  return points;
}

// Distance to the k-th nearest photon; `reach` if fewer than k lie within half of it. The search starts with
// a small radius and doubles it, so that it costs little for a map of any size.
float nearest_radius(const photon::PhotonMap& map, photon::GatherQuery query, float reach, uint32_t k) {
  photon::GatherCounters ignored;
  for (query.radius = reach / 4096; query.radius < reach; query.radius *= 2)
    if (const float r = photon::nearest_radius(map, query, k, ignored); r < query.radius) return r;
  return reach;
}

// Takes the side where photons are denser: on the other side the next ones may be at the far wall of a hollow
// ball, whose normals are the same.
float nearest_radius(const photon::PhotonMap& map, const VisiblePoint& point, float reach, uint32_t k) {
  const float r = nearest_radius(map, point.query, reach, k);
  if (!point.both_sides) return r;
  photon::GatherQuery behind = point.query;
  behind.n = -behind.n;
  return std::min(r, nearest_radius(map, behind, reach, k));
}

// Median, over the points, of the distance to the k-th nearest photon. Points that find fewer are left out; 0
// if none is left.
float median_radius(const photon::PhotonMap& map, const std::vector<VisiblePoint>& points, float reach,
                    uint32_t k) {
  std::vector<float> radii(points.size());
  parallel::for_index(size_t(0), points.size(),
                      [&](size_t i) { radii[i] = nearest_radius(map, points[i], reach, k); });
  radii.erase(std::remove_if(radii.begin(), radii.end(), [&](float r) { return !(r > 0 && r < reach); }),
              radii.end());
  if (radii.empty()) return 0;
  const auto chosen = radii.begin() + std::ptrdiff_t(radii.size() / 2);
  std::nth_element(radii.begin(), chosen, radii.end());
  return *chosen;
}

// k for the photons of all passes together; the map holds those of one.
double photons_to_reach(const RadiusRule& rule, double photons) {
  const double root = std::cbrt(photons / 1e6);
  return std::clamp(rule.of_million * root * root, rule.least, 1e9);
}
uint32_t photons_to_reach(const RadiusRule& rule, const photon::PhotonMap& map, const PassShare& pass) {
  return uint32_t(std::lround(photons_to_reach(rule, double(map.size()) * double(pass.shares))));
}

}  // namespace

// If every point fails with k photons, fewer are tried; the last resort is a fixed fraction of the scene.
float radius_with_photons(const photon::PhotonMap& map, const std::vector<VisiblePoint>& points, float reach,
                          uint32_t photons, const PassShare& pass) {
  if (map.empty()) return reach / 64;  // maps of other passes need not be empty
  for (uint32_t k = photons_in_reach(photons, pass.shares); k > 0; k /= 2)
    if (const float r = median_radius(map, points, reach, k); r > 0) return r;
  return reach / 64;
}

namespace {

uint32_t photons_in_indirect_disc(const PhotonMaps& maps, const PassShare& pass) {
  const double left = maps.split ? maps.split->stored : 1;
  const double photons = photons_to_reach(kIndirectRule, maps.indirect.map, pass) * std::cbrt(left);
  return std::max(uint32_t(std::lround(photons)), kFewestInReach);
}

// The radius of the indirect map. Where paths find some of the light, that of a map of all photons.
float indirect_radius(const PhotonMaps& maps, const std::vector<VisiblePoint>& points, float reach,
                      const PassShare& pass) {
  const photon::PhotonMap& map = maps.indirect.map;
  return radius_with_photons(map, points, reach, photons_in_indirect_disc(maps, pass), pass);
}

// Which ray the radius of photons in media is chosen for, of those that pass any.
enum class RayChoice {
  kMedian,       // half of the rays have fewer photons in reach
  kMedianPhoton  // half of the photons in reach of rays belong to rays with fewer: caustics fill little of
                 // the picture
};

uint64_t chosen_count(std::vector<uint64_t> counts, RayChoice choice) {
  std::erase(counts, uint64_t{0});
  if (counts.empty()) return 0;
  std::sort(counts.begin(), counts.end());
  if (choice == RayChoice::kMedian) return counts[counts.size() / 2];
  std::vector<uint64_t> sums(counts.size());
  std::partial_sum(counts.begin(), counts.end(), sums.begin());
  const auto half = std::lower_bound(sums.begin(), sums.end(), (sums.back() + 1) / 2);
  return counts[size_t(half - sums.begin())];
}

// The radius at which the chosen ray has k photons in reach. Their number grows with the square of the
// radius.
float beam_radius(const photon::PhotonMap& map, const std::vector<Beam>& beams, float reach, uint32_t k,
                  RayChoice choice) {
  if (map.empty() || beams.empty()) return reach / 64;
  float radius = reach / 256;
  std::vector<uint64_t> counts(beams.size());
  for (int round = 0; round < 3; ++round) {
    parallel::for_index(size_t{0}, beams.size(), [&](size_t i) {
      const Beam& beam = beams[i];
      counts[i] = photon::count_along(map, {beam.ray, beam.distance, radius, beam.medium});
    });
    const uint64_t count = chosen_count(counts, choice);
    if (count == 0) return radius;
    radius = std::min(radius * float(std::sqrt(double(k) / double(count))), reach / 8);
  }
  return radius;
}

}  // namespace

float gap_below_walls(float radius) {
  constexpr float kShareOfRadius = 0.25f;
  return std::ldexp(1.0f, std::ilogb(kShareOfRadius * radius));
}

double photons_in_reach_of_indirect(double photons) {
  return photons_to_reach(kIndirectRule, photons);
}

GatherRadii choose_radii(const RenderInput& input, const PassShare& pass, const PhotonMaps& maps) {
  const RenderSettings& settings = input.settings;
  if (const auto r = settings.radius) return {*r, *r, *r, 0, 0, *r, *r, 0, 0, 0};
  const float reach = 2 * input.scene.bounds.radius(), f = settings.radius_factor;
  const auto visible = visible_points(input, kPilotPoints);
  const auto choose = [&](const photon::PhotonMap& map, const auto& points, uint32_t k) {
    return f * radius_with_photons(map, points, reach, k, pass);
  };
  // Shadow photons are as dense as direct photons would be without what casts the shadows, and like caustics
  // they fill little of the picture.
  const bool signed_light = maps.direct.map.empty() && !maps.shadow.empty();
  const photon::PhotonMap& direct = signed_light ? maps.shadow : maps.direct.map;
  const uint32_t caustic = photons_to_reach(kCausticRule, maps.caustic.map, pass);
  const float caustic_reach = settings.lookup == Lookup::kLeaf ? kLeafReach : kCausticReach;
  const uint32_t of_direct = photons_to_reach(kDirectRule, direct, pass);
  const auto scaled = [&](double k) {
    return uint32_t(std::lround(std::clamp(k * double(f) * double(f), double(kFewestInReach), 1e9)));
  };
  const std::vector<Beam> beams = input.plan.medium_caustics || input.plan.medium_indirect
                                      ? pilot_beams(input, kPilotPoints)
                                      : std::vector<Beam>{};
  const auto along = [&](const photon::PhotonMap& map, uint32_t k, RayChoice choice) {
    return f * beam_radius(map, beams, reach, photons_in_reach(k, pass.shares), choice);
  };
  const uint32_t medium_caustic = photons_to_reach(kMediumCausticRule, maps.medium_caustic.map, pass);
  const uint32_t medium_indirect = photons_to_reach(kMediumIndirectRule, maps.medium_indirect.map, pass);
  const bool by_photons = input.plan.direct == DirectEstimator::kPhotons;
  return {choose(direct, signed_light ? photon_points(direct) : visible, of_direct),
          caustic_reach * choose(maps.caustic.map, photon_points(maps.caustic.map), caustic),
          kIndirectReach * f * indirect_radius(maps, visible, reach, pass),
          scaled(caustic),
          by_photons ? scaled(kDirectDensity * of_direct) : 0,
          kMediumCausticReach * along(maps.medium_caustic.map, medium_caustic, RayChoice::kMedianPhoton),
          along(maps.medium_indirect.map, medium_indirect, RayChoice::kMedian),
          scaled(medium_caustic),
          scaled(2.0 * medium_indirect),
          scaled(double(kIndirectReach) * double(kIndirectReach) * photons_in_indirect_disc(maps, pass))};
}

}  // namespace kaustik::render
