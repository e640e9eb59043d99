#pragma once
// Polygons in space as triangles.

#include <array>
#include <span>
#include <vector>

#include "core/math/vec.h"

namespace kaustik::pbrt {

// Most corners of a polygon that is not convex; others of so many become a fan all the same.
inline constexpr size_t kMostEars = 1024;

// Writes n - 2 triangles of the polygon's n >= 3 corners (indices into P), with its winding: a fan about the
// first corner where the polygon is convex, else by cutting off ears, as seen along its mean normal.
void triangulate(std::span<const uint32_t> corners, const std::vector<Point3>& P,
                 std::array<uint32_t, 3>* triangles);

}  // namespace kaustik::pbrt
