#pragma once
// Scenes to trace rays in: some from the repository, and procedural ones of any size.

#include <filesystem>
#include <stdexcept>
#include <string>

#include "apps/import/import_scene.h"
#include "apps/import/pbrt/transforms.h"
#include "core/scene/scene.h"

namespace kaustik::benchmarks {

inline void add_shape(Scene& scene, uint32_t material, TriangleMesh mesh) {
  Shape shape;
  shape.geometry = std::move(mesh);
  shape.material = material;
  shape.surface_group = static_cast<uint32_t>(scene.shapes.size());
  scene.shapes.push_back(std::move(shape));
}

inline void add_quad(Scene& scene, uint32_t material, Point3 p, Vector3 a, Vector3 b) {
  TriangleMesh mesh;
  mesh.P = {p, p + a, p + a + b, p + b};
  mesh.indices = {{0, 1, 2}, {0, 2, 3}};
  add_shape(scene, material, std::move(mesh));
}

inline void add_light(Scene& scene, uint32_t material, Point3 p, Vector3 a, Vector3 b, float L) {
  add_quad(scene, material, p, a, b);
  scene.shapes.back().light = static_cast<uint32_t>(scene.lights.size());
  scene.lights.emplace_back(*DiffuseAreaLight::make(scene.shapes.back(), Rgb(L), false));
}

// A wavy sheet of 2 n^2 triangles over [-half, half]^2.
inline void add_sheet(Scene& scene, uint32_t material, float height, float wave, float half, uint32_t n) {
  TriangleMesh mesh;
  for (uint32_t j = 0; j <= n; ++j) {
    for (uint32_t i = 0; i <= n; ++i) {
      const float x = -half + 2 * half * float(i) / float(n), z = -half + 2 * half * float(j) / float(n);
      mesh.P.push_back({x, height + wave * std::sin(9 * x) * std::sin(7 * z), z});
    }
  }
  for (uint32_t j = 0; j < n; ++j) {
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t v = j * (n + 1) + i;
      mesh.indices.push_back({v, v + 1, v + n + 2});
      mesh.indices.push_back({v, v + n + 2, v + n + 1});
    }
  }
  add_shape(scene, material, std::move(mesh));
}

// look_at: eye, target and up vector, nine numbers.
inline void set_camera(Scene& scene, const std::vector<double>& look_at, float fov_degrees) {
  scene.camera.to_world = Transform::from_matrix(glm::inverse(*pbrt::look_at(look_at)));
  scene.camera.projection = PerspectiveProjection{fov_degrees, {}};
  scene.camera.set_default_screen_window();
}

// A closed box with an area light: 14 + 4 sheet^2 triangles. With sheet > 0 it has two wavy sheets, one of
// them of glass. The camera is inside.
inline Scene room(uint32_t sheet) {
  Scene scene;
  scene.materials = {Lambertian{Rgb(0.75f)}, Lambertian{{0.75f, 0.25f, 0.25f}}, Dielectric{1.33f}};
  add_quad(scene, 0, {-1, -1, -1}, {0, 0, 2}, {2, 0, 0});
  add_quad(scene, 0, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2});
  add_quad(scene, 1, {-1, -1, -1}, {0, 2, 0}, {0, 0, 2});
  add_quad(scene, 0, {1, -1, -1}, {0, 0, 2}, {0, 2, 0});
  add_quad(scene, 0, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0});
  add_quad(scene, 0, {-1, -1, 1}, {0, 2, 0}, {2, 0, 0});
  if (sheet > 0) {
    add_sheet(scene, 2, 0.0f, 0.1f, 0.9f, sheet);
    add_sheet(scene, 1, -0.6f, 0.1f, 0.9f, sheet);
  }
  add_light(scene, 0, {-0.25f, 0.99f, -0.25f}, {0.5f, 0, 0}, {0, 0, 0.5f}, 10);
  set_camera(scene, {0, 0.6, 0.95, 0, -0.2, 0, 0, 1, 0}, 60);
  finalize_scene(scene);
  return scene;
}

// Water with waves over the floor of a box with an open front, under a light of 5 x 4 mm: 103,070 triangles.
inline Scene water_box() {
  Scene scene;
  scene.materials = {Lambertian{Rgb(0.72f)}, Lambertian{{0.63f, 0.07f, 0.05f}},
                     Lambertian{{0.14f, 0.45f, 0.09f}}, Dielectric{1.33f}};
  add_quad(scene, 0, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  add_quad(scene, 0, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2});
  add_quad(scene, 1, {-1, 0, -1}, {0, 2, 0}, {0, 0, 2});
  add_quad(scene, 2, {1, 0, -1}, {0, 0, 2}, {0, 2, 0});
  add_quad(scene, 0, {-1, 0, -1}, {2, 0, 0}, {0, 2, 0});
  add_sheet(scene, 3, 0.9f, 0.02f, 0.999f, 227);
  add_light(scene, 0, {-0.0025f, 1.98f, -0.032f}, {0.005f, 0, 0}, {0, 0, 0.004f}, 1e5f);
  set_camera(scene, {0, 1.2, 6.8, 0, 0.9, 0, 0, 1, 0}, 20);
  finalize_scene(scene);
  return scene;
}

// name: a file below scenes/. Throws std::runtime_error when it is not a scene.
inline Scene scene_file(const std::string& name) {
  Diagnostics diagnostics;
  auto loaded = pbrt::load_scene(std::filesystem::path(KAUSTIK_SCENES_DIR) / name, diagnostics);
  if (!loaded) throw std::runtime_error(name + ": not a scene");
  return std::move(loaded->scene);
}

}  // namespace kaustik::benchmarks
