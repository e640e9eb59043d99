#pragma once
// Orthonormal frame about a normal (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").

#include <cmath>

#include "core/math/vec.h"

namespace kaustik {

// Right-handed orthonormal frame with a given unit vector as its z axis.
struct Frame {
  Vector3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  static Frame from_z(const Vector3& z) {
    const float sign = std::copysign(1.0f, z.z);
    const float a = -1.0f / (sign + z.z);
    const float b = z.x * z.y * a;
    return {{1 + sign * z.x * z.x * a, sign * b, -sign * z.x}, {b, sign + z.y * z.y * a, -z.y}, z};
  }
  // x is the projection of `along` onto the plane across z; arbitrary where the projection vanishes.
  static Frame from_z(const Vector3& z, const Vector3& along) {
    const Vector3 across = along - glm::dot(along, z) * z;
    const float length = glm::length(across);
    if (!(length > 0 && length <= std::numeric_limits<float>::max())) return from_z(z);
    const Vector3 x = across / length;
    return {x, glm::cross(z, x), z};
  }
  Vector3 to_local(const Vector3& v) const { return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)}; }
  Vector3 to_world(const Vector3& v) const { return v.x * x + v.y * y + v.z * z; }
};

}  // namespace kaustik
