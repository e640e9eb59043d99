#pragma once
// Cylinders, and parts of spheres and disks: cut by planes across their axis and by an angle about it. Whole
// spheres and disks have types of their own (core/geometry/shape.h), which are faster.

#include "core/math/bounds.h"
#include "core/math/ray.h"
#include "core/math/transform.h"

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

  bool full_turn() const { return phi_max >= 2 * kPi; }
};

// t of the nearest intersection with 0 < t < ray.t_max, or kInfinity; sets uv to the local xy for disks.
float intersect_quadric(const Quadric& quadric, const Ray& ray, Point2* uv);

// The surface point at azimuth phi (radians); s in [0, 1] leads from z_min to z_max, or from the inner rim of
// a disk to the outer one. Local space, in double.
glm::dvec3 point_at(const Quadric& quadric, double s, double phi);
// Outside normal at p: local, unit.
glm::dvec3 normal_at(const Quadric& quadric, const glm::dvec3& p);

// Uniformly distributed point of the surface in local space, for u in [0, 1)^2.
Point3 sample_uniform(const Quadric& quadric, const Point2& u);

// Bound on the error of a surface point along the normal, metres.
float quadric_error(const Quadric& quadric);
Bounds3 bounds_of(const Quadric& quadric);
double area_of(const Quadric& quadric);  // m^2

}  // namespace kaustik
