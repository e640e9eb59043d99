// Explores surroundings by cosine-weighted rays, and samples the direct light where they end.

#include "render/explore/surroundings.h"

#include <algorithm>
#include <cmath>

#include "core/parallel/cancellable.h"
#include "core/sampling/sampler.h"
#include "core/sampling/warp.h"
#include "render/camera/shading_point.h"

namespace kaustik::render {

namespace {

// Separates the random numbers of these rays from all others.
constexpr uint64_t kClearanceStream = 0xC1EA;
constexpr int kMostSpecular = 4;

// One sample of the light, as the luminance that y scatters of it; 0 if it is hidden.
float sample_of(const RenderInput& input, const Light& light, const ShadingPoint& y, const Point2& u) {
  const auto s = sample_Li(light, y.receiver(), u);
  if (!s || !(s->pdf > 0)) return 0;
  const float L = luminance(f_cos(y, s->wi) * s->Li) / s->pdf;
  if (!(L > 0)) return 0;
  Ray ray = s->infinite ? y.si.spawn(s->wi) : y.si.spawn(s->wi, 1);
  if (!s->infinite) ray.d = s->p_light - ray.o;
  return input.bvh.occluded(ray) ? 0 : L;
}

// Samples the direct light that y scatters, as luminance: a few lights each, one of many.
float direct_sample(const RenderInput& input, const ShadingPoint& y, Sampler& sampler) {
  const float u_light = sampler.next_1d();
  const Point2 u = sampler.next_2d();
  const std::vector<Light>& lights = input.scene.lights;
  if (lights.size() > LightSampler::kMostByPower) {
    const auto choice = input.scene.light_sampler.choose(y.receiver(), u_light);
    return choice ? sample_of(input, lights[choice->light], y, u) / choice->probability : 0;
  }
  float sum = 0;
  for (const Light& light : lights) sum += sample_of(input, light, y, u);
  return sum;
}

struct Met {
  float distance = kInfinity;  // to the first surface with diffuse lobes, through specular ones
  float light = 0;             // luminance that it scatters back
};

Met follow(const RenderInput& input, Ray ray, Sampler& sampler) {
  Met met{0, 0};
  for (int events = 0; events <= kMostSpecular; ++events) {
    SurfaceInteraction si;
    if (!input.bvh.intersect(ray, &si)) return {};
    met.distance += glm::distance(ray.o, si.p);
    const ShadingPoint y(input.scene, si, -ray.d);
    if (!y.specular()) {
      met.light = direct_sample(input, y, sampler);
      return met;
    }
    const auto s = scatter(y, sampler);
    if (!s) return met;
    ray = si.spawn(s->wi);
  }
  return met;
}

}  // namespace

void Surroundings::Cell::add(const Cell& other) {
  inverse += other.inverse;
  light_by_distance += other.light_by_distance;
  light += other.light;
  squared += other.squared;
  rays += other.rays;
}

float Surroundings::Cell::clearance() const {
  return inverse > 0 ? float(rays / inverse) : kInfinity;
}

float Surroundings::Cell::lit_clearance() const {
  return light_by_distance > 0 ? float(light / light_by_distance) : kInfinity;
}

float Surroundings::Cell::noise() const {
  constexpr double kEven = 0.7;
  if (!(light > 0)) return float(kEven);
  return float(std::max(std::sqrt(std::max(squared * rays / (light * light) - 1, 0.0)), kEven));
}

Surroundings::Cell Surroundings::explore(const RenderInput& input, const SurfaceInteraction& si,
                                         const Normal3& n, Sampler& sampler) {
  const Frame frame = Frame::from_z(n);
  Cell sum;
  for (int i = 0; i < kRaysEach; ++i) {
    const Point2 u = sampler.next_2d();
    const Point2 stratified((float(i % 4) + u.x) / 4, (float(i / 4) + u.y) / 4);
    const Vector3 wi = frame.to_world(sample_cosine_hemisphere(stratified));
    ++sum.rays;
    if (!(glm::dot(wi, n) > 0)) continue;
    const Met met = follow(input, si.spawn(wi), sampler);
    if (met.distance > 0) {
      sum.inverse += 1 / double(met.distance);
      sum.light_by_distance += double(met.light) / double(met.distance);
    }
    sum.light += double(met.light);
    sum.squared += double(met.light) * double(met.light);
  }
  return sum;
}

Surroundings::Surroundings(const RenderInput& input, const std::function<bool()>& go_on) {
  const std::vector<VisiblePoint> points = visible_points(input, pilot_count(input));
  struct Found {
    Cell front, back;
  };
  std::vector<Found> found(points.size());
  const auto look_around = [&](size_t i) {
    Sampler sampler(hash_combine(input.settings.seed, kClearanceStream), i);
    const VisiblePoint& x = points[i];
    found[i].front = explore(input, x.si, x.query.n, sampler);
    if (x.both_sides) found[i].back = explore(input, x.si, -x.query.n, sampler);
  };
  if (!parallel::for_index_while(go_on, size_t{0}, points.size(), look_around)) return;
  for (size_t grid = 0; grid < grids_.size(); ++grid) grids_[grid] = {points, kResolution[grid]};
  for (size_t i = 0; i < points.size(); ++i) {
    add(points[i].query.p, points[i].query.n, found[i].front);
    if (points[i].both_sides) add(points[i].query.p, -points[i].query.n, found[i].back);
  }
  lower_quartile_ = quartile_of(points);
}

float Surroundings::quartile_of(const std::vector<VisiblePoint>& points) const {
  std::vector<float> clearances;
  for (const VisiblePoint& point : points) {
    const Place place = at(point.query.p, point.query.n);
    if (place.clearance > 0) clearances.push_back(std::min(place.clearance, place.lit_clearance));
  }
  if (clearances.empty()) return kInfinity;
  const auto quartile = clearances.begin() + std::ptrdiff_t(clearances.size() / 4);
  std::nth_element(clearances.begin(), quartile, clearances.end());
  return *quartile;
}

void Surroundings::add(const Point3& p, const Normal3& n, const Cell& found) {
  for (size_t grid = 0; grid < grids_.size(); ++grid) cells_[grid][grids_[grid].key(p, n)].add(found);
  all_.add(found);
}

Place Surroundings::at(const Point3& p, const Normal3& n) const {
  Place place{.noise = all_.noise()};
  for (size_t grid = 0; grid < grids_.size(); ++grid) {
    const auto found = cells_[grid].find(grids_[grid].key(p, n));
    if (found == cells_[grid].end() || found->second.rays < kEnough[grid]) continue;
    const Cell& cell = found->second;
    if (place.clearance == 0) place.clearance = cell.clearance();
    if (cell.rays < kEnoughForLight) continue;
    place.lit_clearance = cell.lit_clearance(), place.noise = cell.noise();
    break;
  }
  return place;
}

}  // namespace kaustik::render
