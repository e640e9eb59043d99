// Intersection, bounds and area of spheres and ellipsoids.

#include "core/geometry/analytic/sphere.h"

#include <array>
#include <cmath>
#include <numbers>

#include "core/geometry/analytic/quadric_bounds.h"

namespace kaustik {

float intersect_sphere(const Sphere& sphere, const Ray& ray) {
  const Vector3 o = sphere.to_world.inverse_point(ray.o);
  const Vector3 d = sphere.to_world.inverse_vector(ray.d);
  const float a = glm::dot(d, d);
  const float b = -glm::dot(o, d);
  // Haines et al. 2019: compute the discriminant from the point of the line nearest to the centre, which
  // avoids cancellation for distant origins.
  const Vector3 nearest = o + (b / a) * d;
  const float discriminant = 1 - glm::dot(nearest, nearest);
  if (!(discriminant >= 0)) return kInfinity;
  const float root = std::sqrt(a * discriminant);
  // The sign of c tells outside from inside. An origin that left the surface by its error bound is certain to
  // lie on its side, so the near root has the right sign and t needs no threshold.
  const float distance = glm::length(o);
  const float c = (distance - 1) * (distance + 1);
  if (c > 0) {
    if (b <= 0) return kInfinity;  // outside, moving away
    const float t = c / (b + root);
    return t > 0 && t < ray.t_max ? t : kInfinity;
  }
  // Inside: take the far root, in the form without cancellation.
  const float t = b >= 0 ? (b + root) / a : c / (b - root);
  return t > 0 && t < ray.t_max ? t : kInfinity;
}

SurfacePoint Sphere::at_hit(const Ray& ray, float t, const Point2& /*uv*/) const {
  // Rounding may lose the point of a ray from very far away, whatever its place on the sphere.
  const Vector3 on_sphere = unit_vector(to_world.inverse_point(ray.o) + t * to_world.inverse_vector(ray.d));
  return {to_world.point(on_sphere), sphere_error(to_world), unit_vector(to_world.normal(on_sphere))};
}

Bounds3 Sphere::bounds() const {
  return bounds_about(to_world.translation, half_extent(to_world.linear, 3), sphere_error(to_world));
}

std::optional<double> Sphere::radius() const {
  if (!is_similarity(to_world.linear)) return std::nullopt;
  const glm::dmat3 m(to_world.linear);
  return std::sqrt((glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2])) / 3);
}

// Integrates the area element of an ellipsoid, |det M| |M^-T n| per solid angle of the unit sphere. The
// integrand is smooth and periodic in phi, so the midpoint rule converges fast.
double Sphere::area() const {
  if (const auto r = radius()) return 4 * std::numbers::pi * *r * *r;
  constexpr int kRings = 128, kSectors = 64;
  const glm::dmat3 m(to_world.linear);
  const glm::dmat3 inverse_transpose = glm::transpose(glm::inverse(m));
  std::array<glm::dvec3, kSectors> equator;  // normals there
  for (int j = 0; j < kSectors; ++j) {
    const double phi = 2 * std::numbers::pi * (j + 0.5) / kSectors;
    equator[size_t(j)] = inverse_transpose * glm::dvec3(std::cos(phi), std::sin(phi), 0);
  }
  double sum = 0;
  for (int i = 0; i < kRings; ++i) {
    const double z = (2 * i + 1.0) / kRings - 1;
    const double r = std::sqrt(1 - z * z);
    for (const glm::dvec3& n : equator) sum += glm::length(r * n + z * inverse_transpose[2]);
  }
  return std::abs(glm::determinant(m)) * sum * 4 * std::numbers::pi / (kRings * kSectors);
}

}  // namespace kaustik
