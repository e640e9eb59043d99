#pragma once
// Finds out which shapes are parts of one surface. A gather counts only photons of the gather point's own
// surface group; if every shape were a group of its own, a floor made of tiles would be dark along the seams.

#include <string>
#include <vector>

#include "core/geometry/shape.h"

namespace kaustik {

// Sets surface_group of every shape and returns the number of groups, which are numbered in the order of
// their first shape. names: one per shape, empty for none. Shapes with the same name are one group. Shapes
// without a name are one group if they share a boundary edge (both end points bit-identical in world space)
// at which their geometric normals n1, n2 have |n1 . n2| > 0.9; that is, the surface continues across the
// seam with a bend of less than 26 degrees. A flat gather disc that extends over such a bend covers the
// surface's area to within 10 %; over a box's edge it would not. The modulus allows for different windings.
// Deterministic.
uint32_t assign_surface_groups(std::vector<Shape>& shapes, const std::vector<std::string>& names);

}  // namespace kaustik
