// Traces pilot camera rays to the points where light is gathered.

#include "render/maps/visible_points.h"

#include <algorithm>
#include <optional>

#include "core/parallel/parallel.h"
#include "core/sampling/sampler.h"
#include "render/camera/shading_point.h"

namespace kaustik::render {

namespace {

// Separates the random numbers of these rays from those of the image.
constexpr uint64_t kPilotStream = 0x9117;

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
      return VisiblePoint{{si.p, n, si.surface_group}, transmits(*x.bsdf), si, x.wo};
    }
    const auto s = scatter(x, sampler);
    if (!s) return {};
    ray = si.spawn(s->wi);
  }
  return {};
}

}  // namespace

std::vector<VisiblePoint> visible_points(const RenderInput& input, uint32_t count) {
  std::vector<std::optional<VisiblePoint>> found(count);
  parallel::for_index(uint32_t{0}, count, [&](uint32_t i) { found[i] = visible_point(input, i); });
  std::vector<VisiblePoint> points;
  for (const auto& point : found)
    if (point) points.push_back(*point);
  return points;
}

uint32_t pilot_count(const RenderInput& input) {
  constexpr uint64_t kFewest = 1u << 12, kMost = 1u << 14, kPixelsEach = 2;
  const Camera& camera = input.scene.camera;
  const uint64_t pixels = static_cast<uint64_t>(camera.width) * static_cast<uint64_t>(camera.height);
  return static_cast<uint32_t>(std::clamp(pixels / kPixelsEach, kFewest, kMost));
}

}  // namespace kaustik::render
