#pragma once
// Cells of space, for each side of the surfaces in them.

#include "render/explore/visible_points.h"

namespace kaustik::render {

// The longest side of the box of the points, metres; 0 if there are none.
float longest_side(const std::vector<VisiblePoint>& points);

// A cubic grid over the box of a set of visible points. Places outside the box belong to a layer of cells
// around it.
class PlaceGrid {
 public:
  PlaceGrid() = default;
  // cells: number of cells along the longest side of the box.
  PlaceGrid(const std::vector<VisiblePoint>& points, float cells);

  // Key of the cell that holds p, for normals similar to n.
  uint64_t key(const Point3& p, const Normal3& n) const;

 private:
  Point3 low_{0};
  float cells_ = 0, per_cell_ = 0;  // per_cell_: cells per metre
};

}  // namespace kaustik::render
