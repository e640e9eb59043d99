#pragma once
// Parts of scenes with media.

#include "tests/render/support/test_scenes.h"
#include "tests/support/density_grids.h"

namespace kaustik::test {

// Walls about the cube [-1, 1]^3 that emit Le inwards.
inline void add_glowing_walls(Scene& scene, uint32_t material, const Rgb& Le) {
  const Point3 corner[] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                           {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  const int faces[6][4] = {{0, 1, 2, 3}, {5, 4, 7, 6}, {4, 0, 3, 7},
                           {1, 5, 6, 2}, {4, 5, 1, 0}, {3, 2, 6, 7}};
  for (const auto& f : faces)
    make_light(scene,
               add_shape(scene, quad(corner[f[0]], corner[f[1]], corner[f[2]], corner[f[3]], material)), Le);
}

// A ball of smoke for the box of cornell(), bounded by nothing that light meets, whose density is zero in
// places, and which emits Le.
inline void add_smoke(Scene& scene, const Rgb& Le) {
  const auto density = grid_of({12, 14, 9}, {-0.4, 0.8, -0.3}, {0.4, 1.6, 0.5}, [](const glm::dvec3& p) {
    return std::max(1 + 2 * std::sin(12 * p.x + 5 * p.z) * std::cos(9 * p.y), 0.0);
  });
  add_interface(scene, sphere({0, 1.2f, 0.1f}, 0.4f, 0),
                {add_medium(scene, {Rgb(0.5f, 0.2f, 0.1f), Rgb(2, 3, 4), -0.3f, density, Le}), kVacuum});
  finalize_scene(scene);
}

}  // namespace kaustik::test
