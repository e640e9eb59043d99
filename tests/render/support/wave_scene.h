#pragma once
// A box half full of water with waves: the floor is seen, and lit, only through a refracting surface with
// smooth normals.

#include <cmath>

#include "tests/render/support/test_scenes.h"

namespace kaustik::test {

// A height field y = 0.6 + waves over [-1, 1]^2 with its exact normals, outside up.
inline TriangleMesh waves(int cells) {
  TriangleMesh mesh;
  const auto at = [cells](int i) { return -1 + 2 * float(i) / float(cells); };
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) {
      const float x = at(i), z = at(j);
      const float y = 0.6f + 0.02f * std::sin(5 * x + 1) * std::cos(4 * z);
      const float dx = 0.1f * std::cos(5 * x + 1) * std::cos(4 * z);
      const float dz = -0.08f * std::sin(5 * x + 1) * std::sin(4 * z);
      mesh.P.push_back({x, y, z});
      mesh.N.push_back(glm::normalize(Normal3(-dx, 1, -dz)));
    }
  const uint32_t row = uint32_t(cells) + 1;
  for (uint32_t j = 0; j + 1 < row; ++j)
    for (uint32_t i = 0; i + 1 < row; ++i) {
      const uint32_t a = j * row + i, b = a + 1, c = a + row, d = c + 1;
      mesh.indices.push_back({a, c, d});
      mesh.indices.push_back({a, d, b});
    }
  return mesh;
}

inline Scene wave_scene(int size) {
  Scene scene;
  const uint32_t white = add_material(scene, Lambertian{{0.7f, 0.7f, 0.7f}});
  const uint32_t red = add_material(scene, Lambertian{{0.6f, 0.1f, 0.1f}});
  const uint32_t green = add_material(scene, Lambertian{{0.1f, 0.5f, 0.1f}});
  const uint32_t black = add_material(scene, Lambertian{{0, 0, 0}});
  const uint32_t water = add_material(scene, Dielectric{1.8f});
  add_shape(scene, horizontal({0, 0, 0}, 1, 1, true, white));
  add_shape(scene, horizontal({0, 2, 0}, 1, 1, false, white));
  add_shape(scene, quad({-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1}, white));
  add_shape(scene, quad({-1, 0, 1}, {-1, 2, 1}, {1, 2, 1}, {1, 0, 1}, white));
  add_shape(scene, quad({-1, 0, -1}, {-1, 2, -1}, {-1, 2, 1}, {-1, 0, 1}, red));
  add_shape(scene, quad({1, 0, -1}, {1, 0, 1}, {1, 2, 1}, {1, 2, -1}, green));
  Shape surface;
  surface.geometry = waves(24);
  surface.material = water;
  add_shape(scene, std::move(surface));
  Shape& light = add_shape(scene, horizontal({0, 1.95f, 0}, 0.4f, 0.4f, false, black));
  make_light(scene, light, {10, 10, 10});
  look_at(scene, {0, 1.6f, 0.95f}, {0, 0.2f, -0.3f}, {0, 1, 0}, 70, size, size);
  finalize_scene(scene);
  return scene;
}

}  // namespace kaustik::test
