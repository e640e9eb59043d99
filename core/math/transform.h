#pragma once
// Affine maps. A power-of-two scale of everything commutes with every operation here, bit for bit.

#include "core/math/vec.h"

namespace kaustik {

// x -> linear * x + translation; the inverse is kept beside it (both built in double by the importer).
struct Transform {
  glm::mat3 linear{1}, inverse_linear{1};
  Vector3 translation{0};

  // Column-vector convention: m * (p, 1). Throws nothing; a singular m yields non-finite inverses (see
  // invertible()).
  static Transform from_matrix(const glm::dmat4& m);

  Point3 point(const Point3& p) const { return linear * p + translation; }
  Vector3 vector(const Vector3& v) const { return linear * v; }
  // Normals transform with the inverse transpose; the result is not normalised.
  Normal3 normal(const Normal3& n) const { return glm::transpose(inverse_linear) * n; }
  Point3 inverse_point(const Point3& p) const { return inverse_linear * (p - translation); }
  Vector3 inverse_vector(const Vector3& v) const { return inverse_linear * v; }
  bool swaps_handedness() const { return glm::determinant(linear) < 0; }
  bool invertible() const;
};

}  // namespace kaustik
