#pragma once
// Whole spheres and ellipsoids.

#include <optional>

#include "core/geometry/analytic/quadric.h"

namespace kaustik {

// The unit sphere about the origin mapped by to_world: exact, including ellipsoids.
struct Sphere {
  static constexpr std::string_view kName = "sphere";
  static constexpr uint32_t kMostCrossings = 2;

  Transform to_world;

  // AnalyticShape (core/geometry/analytic/analytic_shape.h).
  float intersect(const Ray& ray, Point2* uv) const;
  SurfacePoint at_hit(const Ray& ray, float t, const Point2& uv) const;
  Bounds3 bounds() const;
  double area() const;
  // In metres; nothing for an ellipsoid.
  std::optional<double> radius() const;
  Bounds3 local_bounds() const { return {Point3(-1), Point3(1)}; }
  Quadric swept() const { return {to_world}; }
};

// t of the nearest intersection with 0 < t < ray.t_max, or kInfinity (Haines et al. 2019, "Precision
// Improvements for Ray/Sphere Intersection").
float intersect_sphere(const Sphere& sphere, const Ray& ray);

inline float Sphere::intersect(const Ray& ray, Point2* /*uv*/) const {
  return intersect_sphere(*this, ray);
}

}  // namespace kaustik
