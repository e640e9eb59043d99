#pragma once
// From points of surfaces to coordinates of textures, as pbrt-v4 maps them (pharr 2023, section 10.2).

#include <variant>

#include "core/math/transform.h"
#include "core/texture/texture_point.h"

namespace kaustik {

// Coordinates, and their change along the axes of the footprint.
struct TextureCoordinates {
  Point2 st{0};
  Vector2 dstdx{0}, dstdy{0};
};

// (scale * uv + delta), uv of the shape.
struct UvMapping {
  Vector2 scale{1}, delta{0};
};
// About the origin of texture space: s = theta / pi from +z, t = phi / (2 pi) from +x towards +y.
struct SphereMapping {};
// About the z axis of texture space: s = (pi + atan2(y, x)) / (2 pi), t = z.
struct CylinderMapping {};
// s = delta.x + p . vs, t = delta.y + p . vt in texture space.
struct PlanarMapping {
  Vector3 vs{1, 0, 0}, vt{0, 1, 0};
  Vector2 delta{0};
};

using TextureMapping = std::variant<UvMapping, SphereMapping, CylinderMapping, PlanarMapping>;

// to_world: from texture space. Derivatives on the axis of a mapping, where they have no limit, are zero.
TextureCoordinates map_to_texture(const TextureMapping& mapping, const Transform& to_world,
                                  const TexturePoint& x);

}  // namespace kaustik
