#pragma once
// Whole disks and annuli.

#include "core/geometry/analytic/quadric.h"

namespace kaustik {

// The annulus inner <= |xy| <= 1, z = 0 mapped by to_world. The outside is the side of +z (mapped as a
// normal).
struct Disk {
  static constexpr std::string_view kName = "disk";
  static constexpr uint32_t kMostCrossings = 1;

  Transform to_world;
  float inner = 0;  // inner radius over outer radius, in [0, 1)

  // AnalyticShape (core/geometry/analytic/analytic_shape.h).
  float intersect(const Ray& ray, Point2* uv) const;
  SurfacePoint at_hit(const Ray& ray, float t, const Point2& uv) const;
  Bounds3 bounds() const;
  double area() const;
  Bounds3 local_bounds() const { return {Point3(-1), Point3(1)}; }  // as a ball
  Quadric swept() const { return {to_world, QuadricKind::kDisk, 0, 0, inner}; }
};

// t of the intersection with 0 < t < ray.t_max, or kInfinity; sets uv to the local x and y.
float intersect_disk(const Disk& disk, const Ray& ray, Point2* uv);

inline float Disk::intersect(const Ray& ray, Point2* uv) const {
  return intersect_disk(*this, ray, uv);
}

}  // namespace kaustik
