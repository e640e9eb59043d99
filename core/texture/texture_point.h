#pragma once
#include "core/math/vec.h"

namespace kaustik {

// Where a texture is looked up, and how large the footprint is that its value stands for.
struct TexturePoint {
  Point3 p{0};         // relative to the scene's origin
  Normal3 n{0, 0, 1};  // oriented geometric normal, unit
  Point2 uv{0};        // the shape's own parameters
  // Half axes of the footprint on the surface, as points and as steps of uv. Zero: a point, looked up at the
  // finest level.
  Vector3 dpdx{0}, dpdy{0};
  Vector2 duvdx{0}, duvdy{0};
};

}  // namespace kaustik
