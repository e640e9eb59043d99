#include "apps/import/pbrt/transforms.h"

#include <cmath>
#include <glm/gtc/matrix_access.hpp>

namespace kaustik::pbrt {
namespace {

std::optional<glm::dvec3> unit(const glm::dvec3& v) {
  const double length = glm::length(v);
  if (!(length > 0)) return std::nullopt;
  return v / length;
}

}  // namespace

std::optional<glm::dmat4> look_at(const std::vector<double>& v) {
  const glm::dvec3 eye(v[0], v[1], v[2]);
  const auto ahead = unit(glm::dvec3(v[3], v[4], v[5]) - eye);
  const auto up = unit(glm::dvec3(v[6], v[7], v[8]));
  if (!ahead || !up) return std::nullopt;
  const auto right = unit(glm::cross(*up, *ahead));
  if (!right) return std::nullopt;
  const glm::dvec3 camera_up = glm::cross(*ahead, *right);
  // The inverse of a rigid motion has the camera's axes as rows.
  const glm::dmat3 rotation = glm::transpose(glm::dmat3(*right, camera_up, *ahead));
  glm::dmat4 m(rotation);
  m[3] = glm::dvec4(-(rotation * eye), 1);
  return m;
}

std::optional<glm::dmat4> rotate(const std::vector<double>& v) {
  const auto axis = unit(glm::dvec3(v[1], v[2], v[3]));
  if (!axis) return std::nullopt;
  // Quarter turns are exact, so that tiles rotated against each other keep their common corners.
  const double turns = std::remainder(v[0], 360.0) / 90.0;
  double s = std::sin(glm::radians(v[0]));
  double c = std::cos(glm::radians(v[0]));
  if (turns == std::floor(turns)) {
    const int quarter = (static_cast<int>(turns) + 4) % 4;
    c = quarter == 0 ? 1 : quarter == 2 ? -1 : 0;
    s = quarter == 1 ? 1 : quarter == 3 ? -1 : 0;
  }
  const glm::dvec3 a = *axis;
  const glm::dmat3 cross(0, a.z, -a.y, -a.z, 0, a.x, a.y, -a.x, 0);
  return glm::dmat4(c * glm::dmat3(1) + s * cross + (1 - c) * glm::outerProduct(a, a));
}

glm::dmat4 translate(const std::vector<double>& v) {
  glm::dmat4 m(1);
  m[3] = glm::dvec4(v[0], v[1], v[2], 1);
  return m;
}

glm::dmat4 scale(const std::vector<double>& v) {
  glm::dmat4 m(1);
  for (int k = 0; k < 3; ++k) m[k][k] = v[static_cast<size_t>(k)];
  return m;
}

glm::dmat4 matrix(const std::vector<double>& v) {
  glm::dmat4 m;
  for (size_t i = 0; i < 16; ++i) m[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = v[i];
  return m;
}

glm::dmat4 inverse_transform(const glm::dmat4& m) {
  glm::dmat4 out = glm::inverse(m);
  if (glm::row(m, 3) == glm::dvec4(0, 0, 0, 1)) out = glm::row(out, 3, glm::dvec4(0, 0, 0, 1));
  return out;
}

}  // namespace kaustik::pbrt
