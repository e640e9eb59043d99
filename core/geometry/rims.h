#pragma once
// The rims of disks and other quadrics as boundary edges.

#include "core/geometry/boundary_edges.h"

namespace kaustik {

// The edge from a to b of a facet that contains the inner point c. Its height is zero if the three lie on one
// line.
BoundaryEdge make_edge(const Point3& a, const Point3& b, const Point3& c, const Normal3& n, uint32_t group);

// Adds the rims of a disk or quadric as polygons, of 64 sides for a full turn; those of a disk contain it.
// Adds nothing for other shapes.
void add_rims(const Shape& shape, std::vector<BoundaryEdge>* edges);

}  // namespace kaustik
