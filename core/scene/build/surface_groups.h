#pragma once
// Which shapes are parts of one surface. A photon map counts only photons of the gather point's own surface;
// were every shape a surface of its own, a floor made of tiles would go dark along the seams.

#include <string>
#include <vector>

#include "core/geometry/shape.h"

namespace kaustik {

// Sets surface_group of every shape and returns the number of groups; groups are numbered in order of their
// first shape. names: one per shape, empty for none. Shapes of one name are one group. Shapes without a name
// are one group when they share a boundary edge (both end points bit-identical in world space) at which their
// geometric normals n1, n2 have |n1 . n2| > 0.9, i.e. the surface goes on across the seam bent by less than
// 26 degrees: a flat gather disc that reaches over such a bend still lies within 10 % of the surface's area;
// over a box's edge it would not. Windings may differ, hence the modulus. Deterministic.
uint32_t assign_surface_groups(std::vector<Shape>& shapes, const std::vector<std::string>& names);

}  // namespace kaustik
