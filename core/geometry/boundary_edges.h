#pragma once
// Boundary edges: where surfaces end, at the edges of meshes and the rims of disks and other quadrics. A
// density estimate over a disc that extends beyond them must know how much of the disc lies on the surface.
//
// Not handled: ends that no edge marks, for example the line in which one surface cuts another, and a round
// rim whose facets each bend by less than kBendCosine.

#include <vector>

#include "core/geometry/shape.h"

namespace kaustik {

// One side of an edge: the surface of normal n ends here.
struct BoundaryEdge {
  Point3 a{0}, b{0};
  Normal3 n{0};  // unit, geometric, oriented as SurfaceInteraction::n
  // Unit normal of the facet on the other side of a bend, oriented to the side of n as if the bend were
  // flattened; zero where the surface does not continue.
  Normal3 beyond{0};
  Vector3 outward{0};  // unit, away from the surface: in its plane, perpendicular to the edge
  float height = 0;    // of the facet above this edge, metres
  uint32_t surface_group = 0;
  bool both_sides = false;  // a facet of the opposite orientation that lies on this one ends here, too
};

// How much the surfaces of a surface group bend apart from their edges.
struct SurfaceBend {
  double area = 0;  // m^2
  // rad m: the sum over smooth joints of angle times length (for a cylinder its area over its radius, for a
  // ball its area over half the radius)
  double bend = 0;
  bool oriented = true;  // normals agree across smooth joints
};

// Sorts the edges by surface group; within one they keep their order.
void sort_by_group(std::vector<BoundaryEdge>* edges);

// Limit on the total number of edges of all instances of one mesh. Beyond it they are left out, and estimates
// next to them are too dark.
inline constexpr uint64_t kMostInstanceEdges = 1 << 20;

// Facets whose normals have a cosine above this (26 degrees) count as one smooth surface.
inline constexpr float kBendCosine = 0.9f;

// Finds the edges of triangles at which their surface group ends or bends; an edge at a bend is listed once
// for each side. Two triangles share an edge when both ends are bit-identical in world space, whatever their
// winding and mesh; at an edge of three or more triangles, each continues in the one that bends least.
// Triangles that lie on each other at an edge count as one there. Instances that share a mesh have its edges,
// separately for each instance. Rims of disks are polygons of 64 sides that contain the disk, those of other
// quadrics polygons with corners on the rim. Whole spheres have no edges; triangles without area are left
// out. Edges where unwelded facets meet are listed although the surface continues (see
// accel::without_continued). Takes O(n log n) time. The order depends on the shapes alone and not on their
// scale. bends: if not null, receives the bend of each surface group. Instances count as if they were scaled
// uniformly; joints between two meshes are left out.
std::vector<BoundaryEdge> find_boundary_edges(const std::vector<Shape>& shapes,
                                              std::vector<SurfaceBend>* bends = nullptr);

}  // namespace kaustik
