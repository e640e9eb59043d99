#pragma once
// Affine maps. Scaling by a power of two commutes with every operation here, bit for bit.

#include "core/math/vec.h"

namespace kaustik {

// The map x -> linear * x + translation, stored with its inverse (both built in double by the importer).
struct Transform {
  glm::mat3 linear{1}, inverse_linear{1};
  Vector3 translation{0};

  // Column-vector convention: m * (p, 1). Does not throw: a singular m yields inverses that are not finite
  // (see invertible()).
  static Transform from_matrix(const glm::dmat4& m);

  Point3 point(const Point3& p) const { return linear * p + translation; }
  Vector3 vector(const Vector3& v) const { return linear * v; }
  // Normals transform with the inverse transpose; the result is not normalised.
  Normal3 normal(const Normal3& n) const { return glm::transpose(inverse_linear) * n; }
  Point3 inverse_point(const Point3& p) const { return inverse_linear * (p - translation); }
  Vector3 inverse_vector(const Vector3& v) const { return inverse_linear * v; }
  // Whether the map and its inverse are finite and their product is near the identity.
  bool invertible() const;
};

// Whether m is affine and can be inverted in float precision.
bool is_usable_transform(const glm::dmat4& m);

// The largest row sum of absolute values over the first `columns` columns: a bound on the coordinates of the
// image of the unit box.
inline float max_row_sum(const glm::mat3& m, int columns = 3) {
  Vector3 sum(0);
  for (int c = 0; c < columns; ++c) sum += glm::abs(m[c]);
  return max_component(sum);
}

// Changes an affine map to the world into one to coordinates relative to origin.
inline glm::dmat4 relative_to(const glm::dvec3& origin, glm::dmat4 to_world) {
  to_world[3] -= glm::dvec4(origin, 0);
  return to_world;
}

}  // namespace kaustik
