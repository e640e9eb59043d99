// Measures clearances by rays from visible points.

#include "render/maps/surroundings.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "core/sampling/sampler.h"
#include "core/sampling/warp.h"
#include "render/camera/shading_point.h"

namespace kaustik::render {

namespace {

// Separates the random numbers of these rays from all others.
constexpr uint64_t kClearanceStream = 0xC1EA;
constexpr int kRaysEach = 16;
constexpr int kMostSpecular = 4;

// Distance along the ray to the first surface with diffuse lobes, through specular ones; infinite if there is
// none.
float free_path(const RenderInput& input, Ray ray, Sampler& sampler) {
  float distance = 0;
  for (int events = 0; events <= kMostSpecular; ++events) {
    SurfaceInteraction si;
    if (!input.bvh.intersect(ray, &si)) return kInfinity;
    distance += glm::distance(ray.o, si.p);
    const ShadingPoint y(input.scene, si, -ray.d);
    if (!y.specular()) return distance;
    const auto s = scatter(y, sampler);
    if (!s) return distance;
    ray = si.spawn(s->wi);
  }
  return distance;
}

// Mean of 1 / distance over the hemisphere about n, weighted by the cosine.
float inverse_clearance(const RenderInput& input, const SurfaceInteraction& si, const Normal3& n,
                        Sampler& sampler) {
  const Frame frame = Frame::from_z(n);
  float sum = 0;
  for (int i = 0; i < kRaysEach; ++i) {
    const Point2 u = sampler.next_2d();
    const Point2 stratified((float(i % 4) + u.x) / 4, (float(i / 4) + u.y) / 4);
    const Vector3 wi = frame.to_world(sample_cosine_hemisphere(stratified));
    if (!(glm::dot(wi, n) > 0)) continue;
    if (const float distance = free_path(input, si.spawn(wi), sampler); distance > 0) sum += 1 / distance;
  }
  return sum / kRaysEach;
}

}  // namespace

Surroundings::Surroundings(const RenderInput& input) {
  const std::vector<VisiblePoint> points = visible_points(input, pilot_count(input));
  struct Found {
    float front = 0, back = 0;  // 1 / clearance
  };
  std::vector<Found> found(points.size());
  tbb::parallel_for(size_t{0}, points.size(), [&](size_t i) {
    Sampler sampler(hash_combine(input.settings.seed, kClearanceStream), i);
    const VisiblePoint& x = points[i];
    found[i].front = inverse_clearance(input, x.si, x.query.n, sampler);
    if (x.both_sides) found[i].back = inverse_clearance(input, x.si, -x.query.n, sampler);
  });
  for (size_t grid = 0; grid < grids_.size(); ++grid) grids_[grid] = {points, kResolution[grid]};
  for (size_t i = 0; i < points.size(); ++i) {
    add(points[i].query.p, points[i].query.n, found[i].front);
    if (points[i].both_sides) add(points[i].query.p, -points[i].query.n, found[i].back);
  }
}

void Surroundings::add(const Point3& p, const Normal3& n, float inverse) {
  for (size_t grid = 0; grid < grids_.size(); ++grid) {
    Cell& cell = cells_[grid][grids_[grid].key(p, n)];
    cell.inverse += inverse;
    ++cell.points;
  }
}

float Surroundings::clearance(const Point3& p, const Normal3& n) const {
  for (size_t grid = 0; grid < grids_.size(); ++grid) {
    const auto found = cells_[grid].find(grids_[grid].key(p, n));
    if (found == cells_[grid].end() || found->second.points < kEnough[grid]) continue;
    const Cell& cell = found->second;
    return cell.inverse > 0 ? float(cell.points) / cell.inverse : kInfinity;
  }
  return 0;
}

}  // namespace kaustik::render
