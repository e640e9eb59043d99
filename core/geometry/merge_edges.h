#pragma once
// Merges edges that continue each other on a straight line.
//
// A straight edge of a finely divided mesh is found piece by piece. A disc that reaches it would meet dozens
// of pieces, although one edge says the same.

#include <vector>

#include "core/geometry/boundary_edges.h"

namespace kaustik {

// Replaces runs of edges by single ones: edges of one surface group whose ends are at bit-identical points,
// whose vectors (n, beyond, outward) differ by less than 1/700 and whose both_sides are equal, if all their
// points are within 2^-19 of the coordinates' size of the new edge. Its other members are those of the run's
// middle edge, its height is the least. Sorted by surface group. The result depends on neither the scale (by
// powers of two) nor the number of threads.
std::vector<BoundaryEdge> merge_edges(std::vector<BoundaryEdge> edges);

}  // namespace kaustik
