#pragma once
// What the discs of the indirect map get wrong, by place.
//
// A disc that is not small beside what surrounds it takes photons from where the irradiance is another:
// below a table, in a corner, on a narrow surface. The error is smooth over a place, and paths from a few
// thousand visible points tell it: the ratio of the sum of their estimates to that of the discs' is known for
// a cell of space long before it is known for a pixel. Estimates of the disc are multiplied by that ratio,
// each colour by its own: a disc that takes light from the floor has the floor's colour. What is left is the
// variation of the error within a cell, and the ratio's noise.

#include <array>
#include <unordered_map>

#include "core/math/vec.h"
#include "render/explore/place_grid.h"

namespace kaustik::render {

// Two estimates of the indirect radiance that a point scatters to its viewer.
struct TwoEstimates {
  glm::dvec3 disc{0}, path{0};
};

// Sums over the points of a cell.
struct PointSums {
  glm::dvec3 disc{0}, path{0};
  glm::dvec3 disc_squared{0}, path_squared{0}, product{0};
  uint32_t count = 0;

  void add(const TwoEstimates& e) {
    disc += e.disc, path += e.path;
    disc_squared += e.disc * e.disc, path_squared += e.path * e.path, product += e.disc * e.path;
    ++count;
  }
  glm::dvec3 ratio() const { return path / disc; }
  // Sum of the squares of path - ratio disc.
  glm::dvec3 residual() const {
    const glm::dvec3 r = ratio();
    return glm::max(path_squared - 2.0 * r * product + r * r * disc_squared, glm::dvec3(0));
  }
};

// Immutable; thread-safe.
class DiscCorrection {
 public:
  // found: one for each point; noise of the paths is told apart from errors of the discs by their spread.
  DiscCorrection(const std::vector<VisiblePoint>& points, const std::vector<TwoEstimates>& found);

  // Factors for a disc at p on the side of n; 1 where there was no point near. Cells are blurred: nearby
  // points may get the factors of neighbouring cells.
  Rgb at(const Point3& p, const Normal3& n) const;

 private:
  // Grids from coarse to fine. The ratio of a cell departs from that of the coarser cell around it as far as
  // its own estimates are more than noise (a shrinkage estimator; James and Stein 1961).
  static constexpr std::array<float, 4> kResolution = {4, 12, 36, 72};  // each divides the next

  struct Cell {
    PointSums sums;
    uint64_t parent = 0;  // key of the coarser cell
    glm::dvec3 factor{1};
  };
  void refine(size_t level, const glm::dvec3& everywhere, const glm::dvec3& relative_variance,
              std::unordered_map<uint64_t, Cell>* cells);

  std::array<PlaceGrid, kResolution.size()> grids_;
  std::array<std::unordered_map<uint64_t, Rgb>, kResolution.size()> factors_;
};

}  // namespace kaustik::render
