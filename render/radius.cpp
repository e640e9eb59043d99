#include "render/radius.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/sampling/sampler.h"
#include "render/shading_point.h"

namespace kaustik::render {

namespace {

constexpr uint32_t kPilotPoints = 1024;

// How a map's radius follows from the distances to the k-th nearest photon.
struct RadiusRule {
  uint32_t photons;  // k
  double quantile;   // of those distances
};
// Direct light has edges; indirect light is smooth, and its blotches show where fewer photons are in reach.
constexpr RadiusRule kDirectRule{64, 0.5};
constexpr RadiusRule kIndirectRule{256, 0.5};
// An upper bound: where photons are dense the radius shrinks to the kCausticNearest-th
// (render/photon_maps.cpp).
constexpr RadiusRule kCausticRule{kCausticNearest, 0.5};
constexpr uint64_t kPilotStream = 0x9117;  // keeps the pilot's random numbers apart from the image's

// The first non-specular point of a camera ray, as a query without radius; false where there is none.
bool pilot_query(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings, uint32_t index,
                 photon::GatherQuery* query) {
  Sampler sampler(hash_combine(settings.seed, kPilotStream), index);
  const Point2 u = sampler.next_2d();
  Ray ray = scene.camera.generate_ray({u.x * float(scene.camera.width), u.y * float(scene.camera.height)});
  for (int events = 0; events <= settings.max_bounces; ++events) {
    SurfaceInteraction si;
    if (!bvh.intersect(ray, &si)) return false;
    const ShadingPoint x(scene, si, -ray.d);
    if (!x.specular()) {
      *query = {si.p, glm::dot(si.n, x.wo) < 0 ? -si.n : si.n, si.surface_group};
      return true;
    }
    const auto s = scatter(x, sampler);
    if (!s) return false;
    ray = si.spawn(s->wi);
  }
  return false;
}

std::vector<photon::GatherQuery> visible_queries(const Scene& scene, const accel::Bvh& bvh,
                                                 const RenderSettings& settings) {
  std::vector<photon::GatherQuery> found;
  for (uint32_t i = 0; i < kPilotPoints; ++i) {
    photon::GatherQuery query;
    if (pilot_query(scene, bvh, settings, i, &query)) found.push_back(query);
  }
  return found;
}

// Photons evenly spaced in the map's order.
std::vector<photon::GatherQuery> photon_queries(const photon::PhotonMap& map) {
  std::vector<photon::GatherQuery> queries;
  const uint64_t count = std::min<uint64_t>(map.size(), kPilotPoints);
  for (uint64_t i = 0; i < count; ++i) {
    const photon::Photon p = map.photon(map.size() / count * i);
    queries.push_back({p.p, p.n, p.surface_group});
  }
  return queries;
}

// Distance to the k-th nearest photon; `reach` or more when the scene holds fewer. The search radius grows
// from small, so that a map of any size costs little.
float nearest_radius(const photon::PhotonMap& map, photon::GatherQuery query, float reach, uint32_t k) {
  photon::GatherCounters ignored;
  for (query.radius = reach / 4096; query.radius < reach; query.radius *= 2)
    if (const float r = map.nearest_radius(query, k, ignored); r < query.radius) return r;
  return reach;
}

// Quantile over the queries of the distance to the k-th nearest photon; queries that do not find so many are
// left out. Nothing found gives 0.
float quantile_radius(const photon::PhotonMap& map, const std::vector<photon::GatherQuery>& queries,
                      float reach, const RadiusRule& rule) {
  std::vector<float> radii(queries.size());
  tbb::parallel_for(size_t(0), queries.size(),
                    [&](size_t i) { radii[i] = nearest_radius(map, queries[i], reach, rule.photons); });
  radii.erase(std::remove_if(radii.begin(), radii.end(), [&](float r) { return !(r > 0 && r < reach); }),
              radii.end());
  if (radii.empty()) return 0;
  const auto chosen = radii.begin() + std::ptrdiff_t(double(radii.size()) * rule.quantile);
  std::nth_element(radii.begin(), chosen, radii.end());
  return *chosen;
}

// Where every query fails with k photons, fewer must do; the last resort is a fixed part of the scene.
float auto_radius(const photon::PhotonMap& map, const std::vector<photon::GatherQuery>& queries, float reach,
                  RadiusRule rule, const PassShare& pass) {
  if (map.empty()) return reach / 64;  // those of other passes need not be
  rule.photons = photons_in_reach(rule.photons, pass.shares);
  for (; rule.photons > 0; rule.photons /= 2)
    if (const float r = quantile_radius(map, queries, reach, rule); r > 0) return r;
  return reach / 64;
}

}  // namespace

GatherRadii choose_radii(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                         const PassShare& pass, const PhotonMaps& maps) {
  if (settings.radius) return {*settings.radius, *settings.radius, *settings.radius};
  const float reach = 2 * scene.bounds.radius();
  const auto visible = visible_queries(scene, bvh, settings);
  const float f = settings.radius_factor;
  // Shadow photons lie as densely as direct ones would without what casts the shadows, and like caustics they
  // fill little of the picture.
  const float direct = maps.direct.map.empty() && !maps.shadow.empty()
                           ? auto_radius(maps.shadow, photon_queries(maps.shadow), reach, kDirectRule, pass)
                           : auto_radius(maps.direct.map, visible, reach, kDirectRule, pass);
  return {f * direct,
          f * auto_radius(maps.caustic.map, photon_queries(maps.caustic.map), reach, kCausticRule, pass),
          f * auto_radius(maps.indirect.map, visible, reach, kIndirectRule, pass)};
}

uint32_t caustic_nearest(const RenderSettings& settings, const PassShare& pass) {
  const double area = double(settings.radius_factor) * double(settings.radius_factor);
  const double all = std::clamp(kCausticNearest * area, double(kFewestInReach), 1e9);
  return photons_in_reach(static_cast<uint32_t>(std::lround(all)), pass.shares);
}

}  // namespace kaustik::render
