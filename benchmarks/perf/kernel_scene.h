#pragma once
// The scene of the tracing kernel, made in code, so that changes of importers and scene files do not change
// the work.

#include <cmath>

#include "core/scene/scene.h"

namespace kaustik::benchmarks {

inline Shape& add_shape(Scene& scene, uint32_t material, decltype(Shape::geometry) geometry) {
  Shape& shape = scene.shapes.emplace_back();
  shape.geometry = std::move(geometry);
  shape.material = material;
  shape.surface_group = static_cast<uint32_t>(scene.shapes.size() - 1);
  return shape;
}

// Outside is the side of cross(a, b).
inline TriangleMesh quad(Point3 p, Vector3 a, Vector3 b) {
  TriangleMesh mesh;
  mesh.P = {p, p + a, p + a + b, p + b};
  mesh.indices = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

// A wavy floor of 2 n^2 triangles over [-1, 1]^2.
inline TriangleMesh wavy_floor(uint32_t n) {
  TriangleMesh mesh;
  for (uint32_t i = 0; i < (n + 1) * (n + 1); ++i) {
    const float x = 2 * float(i % (n + 1)) / float(n) - 1, z = 2 * float(i / (n + 1)) / float(n) - 1;
    mesh.P.push_back({x, 0.05f * std::sin(9 * x) * std::sin(7 * z) - 0.9f, z});
  }
  for (uint32_t i = 0; i < n * n; ++i) {
    const uint32_t v = i / n * (n + 1) + i % n;
    mesh.indices.push_back({v, v + n + 1, v + n + 2});
    mesh.indices.push_back({v, v + n + 2, v + 1});
  }
  return mesh;
}

inline Sphere sphere(Point3 centre, float radius) {
  return {Transform{glm::mat3(radius), glm::mat3(1 / radius), centre}};
}

// A closed box with a light, a wavy floor of 8192 triangles, a glass sphere and a mirror sphere: every kind
// of photon, triangles and exact spheres.
inline Scene kernel_scene() {
  Scene scene;
  scene.materials = {Lambertian{Rgb(0.75f)}, Lambertian{{0.75f, 0.25f, 0.25f}}, Dielectric{1.5f}, Mirror{}};
  add_shape(scene, 0, wavy_floor(64));
  add_shape(scene, 0, quad({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}));
  add_shape(scene, 1, quad({-1, -1, -1}, {0, 2, 0}, {0, 0, 2}));
  add_shape(scene, 1, quad({1, -1, -1}, {0, 0, 2}, {0, 2, 0}));
  add_shape(scene, 0, quad({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}));
  add_shape(scene, 0, quad({-1, -1, 1}, {0, 2, 0}, {2, 0, 0}));
  add_shape(scene, 2, sphere({-0.4f, -0.4f, 0.2f}, 0.35f));
  add_shape(scene, 3, sphere({0.45f, -0.4f, -0.3f}, 0.35f));
  Shape& light = add_shape(scene, 0, quad({-0.25f, 0.99f, -0.25f}, {0.5f, 0, 0}, {0, 0, 0.5f}));
  light.light = 0;
  scene.lights.emplace_back(*DiffuseAreaLight::make(light, Rgb(10), false));
  finalize_scene(scene);
  return scene;
}

}  // namespace kaustik::benchmarks
