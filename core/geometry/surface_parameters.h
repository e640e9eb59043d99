#pragma once
// Texture coordinates of a surface point, and the derivatives by them.

#include "core/geometry/interaction.h"

namespace kaustik {

// Parametrisation of a surface near a point, as in pbrt-v4. Triangles use the uv of their vertices, or (0,
// 0), (1, 0) and (1, 1) if they have none. On quadrics u is the azimuth as a fraction of phi_max; v runs from
// z_min to z_max on cylinders, along theta on spheres, and from the outer rim to the inner one on disks.
struct SurfaceParameters {
  Point2 uv{0};
  // Metres per unit of u and v; never parallel. Where uv is degenerate, two arbitrary tangents.
  Vector3 dpdu{1, 0, 0}, dpdv{0, 1, 0};
  Vector3 dndu{0}, dndv{0};  // derivatives of the shading normal
  glm::vec4 colour{1};       // of the mesh's vertices, interpolated; 1 where it has none
};

// Computes the parametrisation of `shape`, on which si lies, from the data that the hit left in si.
SurfaceParameters surface_parameters(const Shape& shape, const SurfaceInteraction& si);

}  // namespace kaustik
