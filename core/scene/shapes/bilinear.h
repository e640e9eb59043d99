#pragma once
// Converts bilinear patches to triangles.

#include <array>
#include <cstdint>
#include <vector>

#include "core/geometry/shape.h"

namespace kaustik {

// Corners of a patch in pbrt's order: p00, p10, p01, p11.
using PatchIndices = std::array<uint32_t, 4>;

struct PatchMesh {
  std::vector<Point3> P;
  std::vector<Normal3> N;  // empty or one per corner
  std::vector<Point2> uv;  // empty or one per corner
  std::vector<PatchIndices> patches;
};

// Flat convex patches (up to the rounding of their corners' coordinates) become two triangles on the corners
// themselves, which is exact. All others become n x n cells of two triangles, with the patch's own normals or
// the interpolated N of its corners. The distance between a cell's diagonal and the patch is at most |p00 -
// p10 - p01 + p11| / (4 n^2); n is the smallest number that keeps this below 1/1024 of the largest distance
// between two corners (so n <= 23). If any patch is curved, all vertices of the result have normals. Without
// uv, the texture coordinates of a patch are its parameters u and v (pbrt's rule), except where flat patches
// share corners. The outside is the side of cross(dp/du, dp/dv).
TriangleMesh triangulate_patches(const PatchMesh& patches);

}  // namespace kaustik
