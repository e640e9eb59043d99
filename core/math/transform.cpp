// Affine maps from matrices, and the test whether they can be inverted.

#include "core/math/transform.h"

namespace kaustik {

Transform Transform::from_matrix(const glm::dmat4& m) {
  const glm::dmat3 linear(m);
  Transform t;
  t.linear = glm::mat3(linear);
  t.inverse_linear = glm::mat3(glm::inverse(linear));
  t.translation = Vector3(m[3]);
  return t;
}

bool Transform::invertible() const {
  for (int c = 0; c < 3; ++c) {
    if (!is_finite(linear[c]) || !is_finite(inverse_linear[c])) return false;
  }
  // The inverse of a singular matrix may be finite if its determinant does not round to zero, but then the
  // product is not the identity.
  const glm::dmat3 product = glm::dmat3(linear) * glm::dmat3(inverse_linear);
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) {
      if (!(std::abs(product[c][r] - (c == r ? 1.0 : 0.0)) < 0.5)) return false;
    }
  }
  return is_finite(translation);
}

bool is_usable_transform(const glm::dmat4& m) {
  return m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1 &&
         Transform::from_matrix(m).invertible();
}

}  // namespace kaustik
