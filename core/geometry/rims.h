#pragma once
// The ends of disks and other quadrics as boundary edges.

#include "core/geometry/boundary_edges.h"

namespace kaustik {

// An edge from a to b of the facet with the inner point c; height zero where they lie on one line.
BoundaryEdge make_edge(const Point3& a, const Point3& b, const Point3& c, const Normal3& n, uint32_t group);

// Rims as polygons, of 64 sides for a full turn; those of disks hold the disk. Nothing for other shapes.
void add_rims(const Shape& shape, std::vector<BoundaryEdge>* edges);

}  // namespace kaustik
