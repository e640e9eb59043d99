#pragma once
#include "core/math/vec.h"

namespace kaustik {

// The equal-area octahedral map of the sphere to the unit square (Clarberg 2008, "Fast Equal-Area Mapping of
// the (Hemi)Sphere using SIMD"; pbrt-v4's environment maps): +z is the centre, -z the four corners. Regions
// of equal area subtend equal solid angles.
Vector3 equal_area_square_to_sphere(const Point2& p);
// The inverse, for unit vectors; within the square.
Point2 equal_area_sphere_to_square(const Vector3& w);
// A point beyond the square by at most one, as the one of the square where the sphere goes on.
Point2 wrap_equal_area_square(Point2 p);

}  // namespace kaustik
