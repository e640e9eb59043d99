#pragma once
// Triangulates polygons in space.

#include <array>
#include <span>
#include <vector>

#include "core/math/vec.h"

namespace kaustik::pbrt {

// Polygons with more corners are split into a fan even where they are concave: ear clipping takes cubic time.
inline constexpr size_t kMostEars = 1024;

// Writes n - 2 triangles for a polygon of n >= 3 corners (indices into P); they wind as the polygon does. A
// convex polygon becomes a fan about its first corner; a concave one is cut by ear clipping in the plane
// across its mean normal.
void triangulate(std::span<const uint32_t> corners, const std::vector<Point3>& P,
                 std::array<uint32_t, 3>* triangles);

}  // namespace kaustik::pbrt
