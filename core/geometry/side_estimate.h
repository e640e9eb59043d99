#pragma once
// Estimates how the triangles of meshes hang together, by a few of them: BVHs of triangles that lie apart and
// the edges of meshes that bend everywhere take several times the memory of smooth ones.

#include <cstdint>
#include <vector>

#include "core/geometry/shape.h"

namespace kaustik {

struct SideEstimate {
  // Sides of triangles at which their mesh ends or bends: edges that find_boundary_edges() lists, before
  // meshes are matched with each other. Includes those of instances.
  double open = 0;
  // Triangles that lie apart from others of their mesh: of each, the square of the share of its sides that no
  // other triangle has. Of a mesh that instances share, once.
  double apart = 0;
};

// Triangles that are looked at, unless there are fewer.
inline constexpr uint64_t kSampledTriangles = 1 << 14;

// Takes O(n) time, and memory of one bit for each vertex of the largest mesh. Depends on the shapes alone.
SideEstimate estimate_sides(const std::vector<Shape>& shapes);

}  // namespace kaustik
