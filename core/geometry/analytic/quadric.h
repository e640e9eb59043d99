#pragma once
// Cylinders, and parts of spheres and disks: cut by planes across their axis and by an angle about it. Whole
// spheres and disks have types of their own (core/geometry/shape.h), which are faster.

#include "core/geometry/analytic/analytic_shape.h"

namespace kaustik {

enum class QuadricKind { kSphere, kCylinder, kDisk };

// The part of the unit sphere, the unit cylinder about z, or the unit disk at z = 0 for which z_min <= z <=
// z_max, inner <= |xy| (disk) and 0 <= azimuth <= phi_max, mapped by to_world. The outside is away from the
// axis, or for disks the side of +z (mapped as a normal).
struct Quadric {
  Transform to_world;
  QuadricKind kind = QuadricKind::kSphere;
  float z_min = -1, z_max = 1;  // spheres: within [-1, 1]
  float inner = 0;              // disks: inner radius, in [0, 1)
  float phi_max = 2 * kPi;      // radians, in (0, 2 pi]

  static constexpr std::string_view kName = "quadric";
  static constexpr uint32_t kMostCrossings = 2;

  bool full_turn() const { return phi_max >= 2 * kPi; }

  // AnalyticShape and SweptShape (core/geometry/analytic/analytic_shape.h). s leads from z_min to z_max, or
  // from the inner rim of a disk to the outer one.
  float intersect(const Ray& ray, Point2* uv) const;
  SurfacePoint at_hit(const Ray& ray, float t, const Point2& uv) const;
  Bounds3 bounds() const;
  double area() const;
  Bounds3 local_bounds() const;
  const Quadric& swept() const { return *this; }
  double turn() const { return double(phi_max); }
  glm::dvec3 point_at(double s, double phi) const;
  glm::dvec3 normal_at(const glm::dvec3& p) const;
  bool flat() const { return kind == QuadricKind::kDisk; }
  int strips(int around) const { return kind == QuadricKind::kSphere ? around / 2 : 1; }
  double strip_at(double t) const;
  bool has_rim(int end) const;
  double bend(double area) const;
  LocalParameters parameters(const Point3& p) const;
  float error() const;
  bool keeps_areas_even() const;
  Point3 sample_uniform(const Point2& u) const;
  Point2 square_of(const Point3& p) const;
  float v_of(float u_x) const;
};

}  // namespace kaustik
