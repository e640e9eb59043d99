// Traces pilot camera rays to the points where light is gathered, and counts these points in cells.

#include "render/maps/visible_points.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/sampling/sampler.h"
#include "render/camera/shading_point.h"

namespace kaustik::render {

namespace {

// Separates the random numbers of these rays from those of the image.
constexpr uint64_t kPilotStream = 0x9117;
constexpr float kCells = 32;

// The first point on a camera ray whose BSDF has diffuse lobes.
std::optional<VisiblePoint> visible_point(const RenderInput& input, uint32_t index) {
  const Scene& scene = input.scene;
  Sampler sampler(hash_combine(input.settings.seed, kPilotStream), index);
  const Point2 u = sampler.next_2d();
  Ray ray = scene.camera.generate_ray({u.x * float(scene.camera.width), u.y * float(scene.camera.height)});
  for (int events = 0; events <= input.settings.max_bounces; ++events) {
    SurfaceInteraction si;
    if (!input.bvh.intersect(ray, &si)) return {};
    const ShadingPoint x(scene, si, -ray.d);
    if (!x.specular()) {
      const Normal3 n = glm::dot(si.n, x.wo) < 0 ? -si.n : si.n;
      return VisiblePoint{{si.p, n, si.surface_group}, transmits(*x.bsdf)};
    }
    const auto s = scatter(x, sampler);
    if (!s) return {};
    ray = si.spawn(s->wi);
  }
  return {};
}

// Index, 0 to 5, of the cube's side through which the normal points.
uint64_t cube_side(const Normal3& n) {
  const glm::vec3 size = glm::abs(n);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  return uint64_t(2 * axis + (n[axis] < 0));
}

}  // namespace

std::vector<VisiblePoint> visible_points(const RenderInput& input, uint32_t count) {
  std::vector<std::optional<VisiblePoint>> found(count);
  tbb::parallel_for(uint32_t{0}, count, [&](uint32_t i) { found[i] = visible_point(input, i); });
  std::vector<VisiblePoint> points;
  for (const auto& point : found)
    if (point) points.push_back(*point);
  return points;
}

VisibleDensity::VisibleDensity(const std::vector<VisiblePoint>& points) {
  Bounds3 bounds;
  for (const VisiblePoint& point : points) bounds.add(point.query.p);
  const Vector3 size = bounds.diagonal();
  const float widest = std::max({size.x, size.y, size.z});
  low_ = bounds.min;
  per_cell_ = widest > 0 ? kCells / widest : 0;
  for (const auto& [query, both_sides] : points) {
    ++counts_[key(query.p, query.n)];
    if (both_sides) ++counts_[key(query.p, -query.n)];
  }
}

float VisibleDensity::at(const photon::Photon& photon) const {
  const auto found = counts_.find(key(photon.p, photon.n));
  return found == counts_.end() ? 0 : found->second;
}

uint64_t VisibleDensity::key(const Point3& p, const Normal3& n) const {
  const glm::vec3 cell = glm::clamp((p - low_) * per_cell_, glm::vec3(-1), glm::vec3(kCells + 1));
  const glm::uvec3 c(glm::floor(cell) + 1.0f);
  return (uint64_t(c.x) << 40 | uint64_t(c.y) << 24 | uint64_t(c.z) << 8) | cube_side(n);
}

}  // namespace kaustik::render
