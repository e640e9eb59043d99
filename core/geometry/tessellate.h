#pragma once
// Quadrics as triangles, for integrals over their area.

#include "core/geometry/shape.h"

namespace kaustik {

// Triangles in world space with corners on the surface, up to 96 about the axis: their area is within 0.1 %
// of that of a round shape. N are the outside normals, negated if flip_normal is set. Empty for meshes.
TriangleMesh tessellated(const Shape& shape);

}  // namespace kaustik
