// Traces pilot camera rays to the points where light is gathered.

#include "render/explore/visible_points.h"

#include <algorithm>
#include <optional>

#include "accel/media_walk.h"
#include "core/parallel/parallel.h"
#include "core/sampling/sampler.h"
#include "core/sampling/warp.h"
#include "photon/emission/emission.h"
#include "render/camera/shading_point.h"

namespace kaustik::render {

namespace {

// Separates the random numbers of these rays from those of the image.
constexpr uint64_t kPilotStream = 0x9117;

// The first point on the ray, or behind mirrors and glass, whose BSDF has diffuse lobes. medium: the ray's.
std::optional<VisiblePoint> first_diffuse(const RenderInput& input, Ray ray, MediumIndex medium,
                                          Sampler& sampler) {
  const Scene& scene = input.scene;
  for (int events = 0; events <= input.settings.max_bounces; ++events) {
    SurfaceInteraction si;
    if (!input.bvh.intersect(ray, &si)) return {};
    medium = accel::walk_media(input.bvh.interfaces(), ray, glm::distance(si.p, ray.o), medium,
                               [](MediumIndex, float, float) { return true; });
    const ShadingPoint x(scene, si, -ray.d);
    if (!x.specular()) {
      const Normal3 n = glm::dot(si.n, x.wo) < 0 ? -si.n : si.n;
      return VisiblePoint{{si.p, n, si.surface_group}, transmits(*x.bsdf), si, medium};
    }
    const auto s = scatter(x, sampler);
    if (!s) return {};
    ray = si.spawn(s->wi);
    medium = medium_beyond(scene, si, x.wo, s->wi, medium);
  }
  return {};
}

std::optional<VisiblePoint> seen_by(const Camera& camera, const RenderInput& input, Sampler& sampler) {
  const Point2 u = sampler.next_2d();
  const Ray ray = camera.generate_ray({u.x * float(camera.width), u.y * float(camera.height)});
  return first_diffuse(input, ray, input.scene.camera_medium, sampler);
}

// The point that a diffuse reflection from `point` leads to.
std::optional<VisiblePoint> reflected(const RenderInput& input, const VisiblePoint& point, Sampler& sampler) {
  const Frame frame = Frame::from_z(point.query.n);
  const Vector3 wi = frame.to_world(sample_cosine_hemisphere(sampler.next_2d()));
  return first_diffuse(input, point.si.spawn(wi), point.medium, sampler);
}

// What some camera may see: where light arrives from the lights, and where it does after up to `reflections`
// diffuse ones.
std::optional<VisiblePoint> lit_point(const RenderInput& input, uint32_t reflections, Sampler& sampler) {
  const photon::EmissionNumbers u = photon::emission_numbers(input.scene, sampler);
  const auto start = photon::emit_photon(input.scene, u, 1, input.settings.emission);
  if (!start) return {};
  const uint32_t light = photon::light_of_photon(input.scene, u.light).light;
  const MediumIndex medium = accel::medium_at_start(input.scene, input.bvh, light, start->ray);
  std::optional<VisiblePoint> point = first_diffuse(input, start->ray, medium, sampler);
  for (uint32_t i = 0; point && i < reflections; ++i) {
    const auto next = reflected(input, *point, sampler);
    if (!next) break;
    point = next;
  }
  return point;
}

// Point `index` of `count`, which are divided evenly among the views.
std::optional<VisiblePoint> visible_point(const RenderInput& input, uint64_t index, uint64_t count,
                                          Sampler& sampler) {
  constexpr uint32_t kReflections = 4;
  if (input.settings.for_camera == ForCamera::kAll)
    return lit_point(input, uint32_t(index % kReflections), sampler);
  if (input.views.empty()) return seen_by(input.scene.camera, input, sampler);
  return seen_by(input.views[index * input.views.size() / count], input, sampler);
}

// The points that find(index, sampler) finds, in the order of their indices.
template <class Find>
std::vector<VisiblePoint> find_points(const RenderInput& input, uint32_t count, const Find& find) {
  std::vector<std::optional<VisiblePoint>> found(count);
  parallel::for_index(uint32_t{0}, count, [&](uint32_t i) {
    Sampler sampler(hash_combine(input.settings.seed, kPilotStream), i);
    found[i] = find(i, sampler);
  });
  std::vector<VisiblePoint> points;
  for (const auto& point : found)
    if (point) points.push_back(*point);
  return points;
}

}  // namespace

std::vector<VisiblePoint> visible_points(const RenderInput& input, uint32_t count) {
  return find_points(input, count, [&](uint32_t i, Sampler& s) { return visible_point(input, i, count, s); });
}

std::vector<VisiblePoint> points_behind_visible(const RenderInput& input, uint32_t count) {
  return find_points(input, count, [&](uint32_t i, Sampler& s) {
    const auto point = visible_point(input, i, count, s);
    return point ? reflected(input, *point, s) : point;
  });
}

uint32_t pilot_count(const RenderInput& input) {
  constexpr uint64_t kFewest = 1u << 12, kMost = 1u << 14, kPixelsEach = 2;
  if (input.settings.for_camera == ForCamera::kAll) return kMost;
  const Camera& camera = input.scene.camera;
  const uint64_t pixels = static_cast<uint64_t>(camera.width) * static_cast<uint64_t>(camera.height);
  return static_cast<uint32_t>(std::clamp(pixels / kPixelsEach, kFewest, kMost));
}

}  // namespace kaustik::render
