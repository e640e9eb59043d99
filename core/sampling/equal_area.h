#pragma once
// The equal-area map between the sphere and the unit square.

#include "core/math/vec.h"

namespace kaustik {

// The equal-area octahedral map from the unit square to the sphere (Clarberg 2008, "Fast Equal-Area Mapping
// of the (Hemi)Sphere using SIMD"), as in pbrt-v4's environment maps. The centre of the square is +z, its
// four corners are -z. Regions of equal area in the square subtend equal solid angles.
Vector3 equal_area_square_to_sphere(const Point2& p);
// The inverse map, for unit vectors. The result lies in [0, 1]^2.
Point2 equal_area_sphere_to_square(const Vector3& w);
// Maps a point up to one unit outside the square to the point inside it at which the map continues on the
// sphere.
Point2 wrap_equal_area_square(Point2 p);

}  // namespace kaustik
