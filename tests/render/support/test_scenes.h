#pragma once
// Small scenes made in code, in metres, each with a factor by which the whole scene is scaled.

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "core/spectrum/refractive_index.h"
#include "render/renderer.h"
#include "tests/render/support/print_names.h"
#include "tests/support/shapes.h"

namespace kaustik::test {

using namespace render;  // the helpers of tests/render/support are about renders

inline uint32_t add_material(Scene& scene, const Bsdf& bsdf) {
  scene.materials.push_back(bsdf);
  scene.material_names.push_back("material " + std::to_string(scene.materials.size()));
  return uint32_t(scene.materials.size() - 1);
}

// Every shape is a surface group of its own unless told otherwise.
inline Shape& add_shape(Scene& scene, Shape shape) {
  shape.surface_group = uint32_t(scene.shapes.size());
  scene.surface_group_names.push_back("group " + std::to_string(shape.surface_group));
  scene.shapes.push_back(std::move(shape));
  return scene.shapes.back();
}

// A horizontal rectangle about (x, y, z), facing up or down.
inline Shape horizontal(const Point3& c, float half_x, float half_z, bool up, uint32_t material) {
  const Point3 a = c + Vector3(-half_x, 0, -half_z), b = c + Vector3(-half_x, 0, half_z);
  const Point3 d = c + Vector3(half_x, 0, half_z), e = c + Vector3(half_x, 0, -half_z);
  return up ? quad(a, b, d, e, material) : quad(a, e, d, b, material);
}

// Adds a medium and returns its index.
inline MediumIndex add_medium(Scene& scene, const Medium& medium) {
  if (scene.media.empty()) scene.media.emplace_back();
  scene.media.push_back(medium);
  return static_cast<MediumIndex>(scene.media.size() - 1);
}
inline MediumIndex add_medium(Scene& scene, const Rgb& sigma_a, const Rgb& sigma_s = Rgb(0), float g = 0) {
  return add_medium(scene, Medium{sigma_a, sigma_s, g});
}

// Fills all space with a medium.
inline void fill(Scene& scene, const Rgb& sigma_a, const Rgb& sigma_s = Rgb(0)) {
  scene.camera_medium = add_medium(scene, sigma_a, sigma_s);
  scene.light_media.assign(scene.lights.size(), scene.camera_medium);
  for (Shape& shape : scene.shapes) shape.media = {scene.camera_medium, scene.camera_medium};
  finalize_scene(scene);
}

// Adds a surface that rays pass and that separates media.
inline void add_interface(Scene& scene, Shape shape, const MediumInterface& media) {
  auto interfaces = std::make_shared<Scene>();
  if (scene.interfaces) interfaces->shapes = scene.interfaces->shapes;
  shape.media = media;
  interfaces->shapes.push_back(std::move(shape));
  for (const Shape& s : interfaces->shapes) interfaces->bounds.add(bounds_of(s));
  scene.interfaces = std::move(interfaces);
}

// Puts the camera at eye, looking towards target; +x of the image is to the right of a viewer in a
// right-handed world.
inline void look_at(Scene& scene, const Point3& eye, const Point3& target, const Vector3& up, float fov,
                    int width, int height) {
  const glm::dvec3 forward = glm::normalize(glm::dvec3(target) - glm::dvec3(eye));
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(up)));
  const glm::dvec3 above = glm::cross(right, forward);
  scene.camera.to_world = Transform::from_matrix(glm::dmat4(
      glm::dvec4(right, 0), glm::dvec4(above, 0), glm::dvec4(forward, 0), glm::dvec4(glm::dvec3(eye), 1)));
  scene.camera.projection = PerspectiveProjection{fov, {}};
  scene.camera.width = width;
  scene.camera.height = height;
  scene.camera.set_default_screen_window();
}

// A closed box [-1, 1] x [0, 2] x [-1, 1] with a red and a green wall, a light of side 0.5 just below the
// ceiling, a glass sphere and a mirror sphere. The camera is inside.
inline Scene cornell(int size, float scale = 1) {
  const float s = scale;
  Scene scene;
  const uint32_t white = add_material(scene, Lambertian{{0.7f, 0.7f, 0.7f}});
  const uint32_t red = add_material(scene, Lambertian{{0.6f, 0.1f, 0.1f}});
  const uint32_t green = add_material(scene, Lambertian{{0.1f, 0.5f, 0.1f}});
  const uint32_t black = add_material(scene, Lambertian{{0, 0, 0}});
  const uint32_t glass = add_material(scene, Dielectric{1.5f});
  const uint32_t mirror = add_material(scene, Mirror{{0.9f, 0.9f, 0.9f}});
  const auto p = [s](float x, float y, float z) { return Point3(x * s, y * s, z * s); };
  add_shape(scene, horizontal(p(0, 0, 0), s, s, true, white));
  add_shape(scene, horizontal(p(0, 2, 0), s, s, false, white));
  add_shape(scene, quad(p(-1, 0, -1), p(1, 0, -1), p(1, 2, -1), p(-1, 2, -1), white));
  add_shape(scene, quad(p(-1, 0, 1), p(-1, 2, 1), p(1, 2, 1), p(1, 0, 1), white));
  add_shape(scene, quad(p(-1, 0, -1), p(-1, 2, -1), p(-1, 2, 1), p(-1, 0, 1), red));
  add_shape(scene, quad(p(1, 0, -1), p(1, 0, 1), p(1, 2, 1), p(1, 2, -1), green));
  add_shape(scene, sphere(p(0.45f, 0.36f, 0.25f), 0.35f * s, glass));
  add_shape(scene, sphere(p(-0.45f, 0.41f, -0.4f), 0.4f * s, mirror));
  Shape& light = add_shape(scene, horizontal(p(0, 1.98f, 0), 0.25f * s, 0.25f * s, false, black));
  make_light(scene, light, {17, 12, 4});
  look_at(scene, p(0, 1, 0.99f), p(0, 0.8f, -1), {0, 1, 0}, 80, size, size);
  finalize_scene(scene);
  return scene;
}

// The box with a sphere of coloured glass that disperses, filled by a thin fog.
inline Scene coloured_cornell(int size, float scale = 1) {
  Scene scene = cornell(size, scale);
  const MediumIndex green = add_medium(scene, Rgb(2, 0.25f, 1) / scale);
  const MediumIndex air =
      add_medium(scene, Rgb(0.1f, 0.1f, 0.2f) / scale, Rgb(0.2f, 0.1f, 0.15f) / scale, 0.3f);
  scene.camera_medium = air;
  scene.light_media.assign(scene.lights.size(), air);
  for (Shape& shape : scene.shapes) {
    const bool glass = std::holds_alternative<Dielectric>(scene.materials[shape.material].typical());
    shape.media = {glass ? green : air, air};
    if (glass)
      scene.materials[shape.material].disperse(std::make_shared<const Spectrum>(abbe_index(1.5, 20)));
  }
  finalize_scene(scene);
  return scene;
}

// The box with a diffuse plate under the light, which casts shadow photons; mirror and glass do not.
inline Scene cornell_with_table(int size) {
  Scene scene = cornell(size);
  add_shape(scene, horizontal({-0.3f, 1.2f, 0}, 0.3f, 0.3f, true, 0));
  finalize_scene(scene);
  return scene;
}

// Renders with the given number of threads, whatever the machine has.
inline RenderResult render_with_threads(const Scene& scene, const RenderSettings& settings, int threads = 2) {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, size_t(threads));
  tbb::task_arena arena(threads);
  RenderResult result;
  arena.execute([&] {
    const accel::Bvh bvh(scene, threads);
    result = render::render(scene, bvh, settings);
  });
  return result;
}

}  // namespace kaustik::test
