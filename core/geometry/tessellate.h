#pragma once
// Quadrics as triangles, for integrals over their area.

#include "core/geometry/shape.h"

namespace kaustik {

// Pieces about the axis, per full turn, with which the area is within 0.1 % of that of a round shape.
inline constexpr int kFineTurn = 96;

// Triangles in world space with corners on the surface. around: pieces per full turn. N are the outside
// normals, negated if flip_normal is set. Empty for meshes.
TriangleMesh tessellated(const Shape& shape, int around = kFineTurn);

// How many triangles that takes, or a mesh has.
uint64_t triangle_count(const Shape& shape, int around = kFineTurn);

}  // namespace kaustik
