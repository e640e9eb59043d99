#pragma once
// Maps from surface points to texture coordinates, as in pbrt-v4 (Pharr 2023, section 10.2).

#include <variant>

#include "core/math/transform.h"
#include "core/texture/texture_point.h"

namespace kaustik {

// Texture coordinates, and their change along the axes of the footprint.
struct TextureCoordinates {
  Point2 st{0};
  Vector2 dstdx{0}, dstdy{0};
};

// scale * (u, v) + shear * (v, u) + delta, where u and v are the shape's own parameters.
struct UvMapping {
  Vector2 scale{1}, delta{0}, shear{0};
};
// Spherical coordinates about the origin of texture space: s = theta / pi from +z, t = phi / (2 pi) from +x
// towards +y.
struct SphereMapping {};
// Cylindrical coordinates about the z axis of texture space: s = (pi + atan2(y, x)) / (2 pi), t = z.
struct CylinderMapping {};
// Parallel projection: s = delta.x + p . vs, t = delta.y + p . vt in texture space.
struct PlanarMapping {
  Vector3 vs{1, 0, 0}, vt{0, 1, 0};
  Vector2 delta{0};
};

using TextureMapping = std::variant<UvMapping, SphereMapping, CylinderMapping, PlanarMapping>;

// to_world maps from texture space to world space. Derivatives are zero on the axis of a mapping, where they
// have no limit.
TextureCoordinates map_to_texture(const TextureMapping& mapping, const Transform& to_world,
                                  const TexturePoint& x);

}  // namespace kaustik
