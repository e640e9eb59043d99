#pragma once
// The arguments of a texture lookup.

#include "core/math/vec.h"

namespace kaustik {

// A texture lookup: the point, and the footprint over which the value is averaged.
struct TexturePoint {
  Point3 p{0};         // relative to the scene's origin
  Normal3 n{0, 0, 1};  // oriented geometric normal, unit
  Point2 uv{0};        // the shape's own parameters
  // Half axes of the footprint on the surface, as vectors and as steps of uv. Zero: a point, looked up at the
  // finest level.
  Vector3 dpdx{0}, dpdy{0};
  Vector2 duvdx{0}, duvdy{0};
  glm::vec4 colour{1};  // red, green, blue and alpha of the mesh's vertices; 1 where it has none
};

}  // namespace kaustik
