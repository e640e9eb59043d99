#pragma once
#include "core/geometry/interaction.h"

namespace kaustik {

// Parametrisation of a surface about a point, pbrt-v4's: triangles by the vertices' uv, or (0, 0), (1, 0) and
// (1, 1) without; of quadrics u is the share of the turn about z, v runs from z_min to z_max, along the
// angle theta of spheres, and from the outer edge of disks to the inner one.
struct SurfaceParameters {
  Point2 uv{0};
  // Metres per unit of u and v; never parallel. Where uv is degenerate, any two tangents.
  Vector3 dpdu{1, 0, 0}, dpdv{0, 1, 0};
  Vector3 dndu{0}, dndv{0};  // of the shading normal
};

// Of the shape that si lies on. Made on demand, from what the hit left in si.
SurfaceParameters surface_parameters(const Shape& shape, const SurfaceInteraction& si);

}  // namespace kaustik
