// Whether a linear map is a similarity.

#include "core/geometry/analytic/analytic_shape.h"

#include "core/math/error_bounds.h"

namespace kaustik {

bool is_similarity(const glm::mat3& m) {
  constexpr float kTolerance = gamma_bound(64);
  const glm::mat3 gram = glm::transpose(m) * m;
  const float size = gram[0][0];
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) {
      if (!(std::abs(gram[c][r] - (c == r ? size : 0)) <= kTolerance * size)) return false;
    }
  }
  return size > 0;
}

}  // namespace kaustik
