#pragma once
// Grids of densities for tests.

#include <memory>
#include <vector>

#include "core/medium/density_grid.h"

namespace kaustik::test {

// The places of a grid's points, which are the centres of the cells of the box from lo to hi.
template <class Fn>
void for_each_point(const glm::ivec3& points, const glm::dvec3& lo, const glm::dvec3& hi, const Fn& fn) {
  for (int z = 0; z < points.z; ++z)
    for (int y = 0; y < points.y; ++y)
      for (int x = 0; x < points.x; ++x)
        fn(lo + (hi - lo) * (glm::dvec3(x, y, z) + 0.5) / glm::dvec3(points));
}

inline glm::dmat4 box_between(const glm::dvec3& lo, const glm::dvec3& hi) {
  glm::dmat4 m(1);
  for (int a = 0; a < 3; ++a) m[a][a] = hi[a] - lo[a], m[3][a] = lo[a];
  return m;
}

// density(p): the density at a point in the box from lo to hi.
template <class Fn>
std::shared_ptr<const DensityGrid> grid_of(const glm::ivec3& points, const glm::dvec3& lo,
                                           const glm::dvec3& hi, const Fn& density) {
  std::vector<double> values;
  for_each_point(points, lo, hi, [&](const glm::dvec3& p) { values.push_back(density(p)); });
  return std::make_shared<const DensityGrid>(points, values, box_between(lo, hi));
}

}  // namespace kaustik::test
