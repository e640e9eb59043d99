#pragma once
// Bilinear patches as triangles.

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
// themselves, which is exact. All others become n x n cells of two triangles with the patch's own normals (or
// the corners' N, interpolated). Between a cell's diagonal and the patch lies at most |p00 - p10 - p01 + p11|
// / (4 n^2); n is the smallest that keeps this below 1/1024 of the largest distance of two corners (so n <=
// 23). Once one patch is curved, all vertices of the result have normals. Without uv, u and v of a patch are
// its parameters (pbrt's rule), save where flat patches have corners in common. The outside is the side of
// cross(dp/du, dp/dv).
TriangleMesh triangulate_patches(const PatchMesh& patches);

}  // namespace kaustik
