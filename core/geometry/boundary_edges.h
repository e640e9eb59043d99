#pragma once
// Where surfaces end: the edges of meshes and the rims of disks and other quadrics. A density estimate on a
// disc that reaches over them must know how much of it lies on the surface.
//
// Not handled: an end that no edge marks, e.g. the line in which one surface cuts through another, and a
// round rim whose facets each bend by less than kBendCosine.

#include <vector>

#include "core/geometry/shape.h"

namespace kaustik {

// One side of an edge: the surface of normal n ends here.
struct BoundaryEdge {
  Point3 a{0}, b{0};
  Normal3 n{0};        // unit, geometric, oriented as SurfaceInteraction::n
  Normal3 beyond{0};   // unit normal of the facet behind the bend, on the side of n were the bend flattened;
                       // zero where nothing follows
  Vector3 outward{0};  // unit, away from the surface: in its plane, perpendicular to the edge
  float height = 0;    // of the facet over this edge, metres
  uint32_t surface_group = 0;
};

// How a surface group bends where it has no edges.
struct SurfaceBend {
  double area = 0;  // m^2
  double bend = 0;  // rad m: over its smooth joints, the angle times the length (a cylinder's area over its
                    // radius, a ball's area over half of it)
  bool oriented = true;  // facets that meet smoothly have their normals on one side
};

// Most edges of all instances of one mesh: where there are more, they are left out, and estimates next to
// them are too dark.
inline constexpr uint64_t kMostInstanceEdges = 1 << 20;

// Facets that meet at an angle of a cosine above this (26 degrees) are one surface for every observer.
inline constexpr float kBendCosine = 0.9f;

// Edges of triangles at which their surface group ends or bends, those of a bend once for each side. Two
// triangles share an edge when both ends are bit-identical in world space, whatever their winding and mesh;
// at an edge of three or more triangles each goes on in the one that bends least. Instances that share a mesh
// have its edges, each for itself. Rims of disks are polygons of 64 sides that hold the disk, those of other
// quadrics polygons of corners on the rim. Whole spheres have no edges; triangles without area are left out.
// Edges where unwelded facets meet are listed although the surface goes on, see accel::without_continued. O(n
// log n); the order depends on shapes alone and not on their scale.
// bends: if not null, becomes how the groups bend, by surface group. Of instances, as if they were scaled
// evenly; joints of two meshes are left out.
std::vector<BoundaryEdge> find_boundary_edges(const std::vector<Shape>& shapes,
                                              std::vector<SurfaceBend>* bends = nullptr);

}  // namespace kaustik
