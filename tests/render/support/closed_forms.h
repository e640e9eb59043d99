#pragma once
// Irradiance in closed forms.

#include <cmath>
#include <glm/glm.hpp>
#include <vector>

namespace kaustik::test {

// Irradiance E(rho) = I h / (rho^2 + h^2)^(3/2) under a point light of intensity I at height h, at the
// distance rho from the point below it.
struct PointLightOverPlane {
  double I = 1, h = 1;
  double irradiance(double rho2) const { return I * h / std::pow(rho2 + h * h, 1.5); }
  // d2E/drho2 + (1/rho) dE/drho = I h (9 rho^2 - 6 h^2) / (rho^2 + h^2)^(7/2)
  double laplacian(double rho2) const { return I * h * (9 * rho2 - 6 * h * h) / std::pow(rho2 + h * h, 3.5); }
};

// Lambert 1760: E = L/2 sum over edges of (angle seen from x) (unit normal of the edge's plane . n).
inline double lambert_polygon(const std::vector<glm::dvec3>& polygon, const glm::dvec3& x,
                              const glm::dvec3& n, double L) {
  double sum = 0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 a = glm::normalize(polygon[i] - x),
                     b = glm::normalize(polygon[(i + 1) % polygon.size()] - x);
    sum += std::acos(glm::dot(a, b)) * glm::dot(glm::normalize(glm::cross(a, b)), n);
  }
  return std::abs(L / 2 * sum);
}

}  // namespace kaustik::test
