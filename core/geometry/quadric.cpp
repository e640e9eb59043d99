// Intersection, sampling, bounds and area of quadrics.

#include "core/geometry/quadric.h"

#include <cmath>

#include "core/geometry/surface_bounds.h"
#include "core/sampling/warp.h"

namespace kaustik {
namespace {

bool within_turn(const Quadric& q, float x, float y) {
  if (q.full_turn()) return true;
  const float phi = std::atan2(y, x);
  return (phi < 0 ? phi + 2 * kPi : phi) <= q.phi_max;
}

bool holds(const Quadric& q, const Point3& p) {
  // Do not lose poles that are not cut off to rounding.
  const bool sphere = q.kind == QuadricKind::kSphere;
  const bool above = p.z >= q.z_min || (sphere && q.z_min <= -1);
  const bool below = p.z <= q.z_max || (sphere && q.z_max >= 1);
  return above && below && within_turn(q, p.x, p.y);
}

float intersect_flat(const Quadric& q, const Point3& o, const Vector3& d, float t_max, Point2* uv) {
  const float t = -o.z / d.z;
  if (!(t > 0 && t < t_max)) return kInfinity;
  const Point2 p(o.x + t * d.x, o.y + t * d.y);
  const float r2 = glm::dot(p, p);
  if (!(r2 <= 1 && r2 >= q.inner * q.inner) || !within_turn(q, p.x, p.y)) return kInfinity;
  *uv = p;
  return t;
}

// Like intersect_sphere (Haines et al. 2019), in three dimensions or, for cylinders, in the two across the
// axis. The part that is met first may be cut away, so both roots are tried.
float intersect_round(const Quadric& q, const Point3& o, const Vector3& d, float t_max) {
  const Vector3 round = q.kind == QuadricKind::kSphere ? Vector3(1) : Vector3(1, 1, 0);
  const Vector3 oc = o * round, dc = d * round;
  const float a = glm::dot(dc, dc), b = -glm::dot(oc, dc);
  const Vector3 nearest = oc + (b / a) * dc;
  const float discriminant = 1 - glm::dot(nearest, nearest);
  if (!(discriminant >= 0)) return kInfinity;
  const float root = std::sqrt(a * discriminant), distance = glm::length(oc);
  const float c = (distance - 1) * (distance + 1);  // positive outside, negative inside
  float t[2] = {kInfinity, kInfinity};
  if (c > 0) {
    if (b <= 0) return kInfinity;
    t[0] = c / (b + root), t[1] = (b + root) / a;
  } else {
    t[0] = b >= 0 ? (b + root) / a : c / (b - root);
  }
  for (const float s : t)
    if (s > 0 && s < t_max && holds(q, o + s * d)) return s;
  return kInfinity;
}

}  // namespace

float intersect_quadric(const Quadric& q, const Ray& ray, Point2* uv) {
  const Point3 o = q.to_world.inverse_point(ray.o);
  const Vector3 d = q.to_world.inverse_vector(ray.d);
  return q.kind == QuadricKind::kDisk ? intersect_flat(q, o, d, ray.t_max, uv)
                                      : intersect_round(q, o, d, ray.t_max);
}

glm::dvec3 point_at(const Quadric& q, double s, double phi) {
  const double z = double(q.z_min) + s * double(q.z_max - q.z_min), inner = q.inner;
  switch (q.kind) {
    case QuadricKind::kSphere: {
      const double r = std::sqrt(std::max(0.0, 1 - z * z));
      return {r * std::cos(phi), r * std::sin(phi), z};
    }
    case QuadricKind::kCylinder:
      return {std::cos(phi), std::sin(phi), z};
    case QuadricKind::kDisk:
      break;
  }
  const double r = inner + s * (1 - inner);
  return {r * std::cos(phi), r * std::sin(phi), 0};
}

glm::dvec3 normal_at(const Quadric& q, const glm::dvec3& p) {
  if (q.kind == QuadricKind::kDisk) return {0, 0, 1};
  return glm::normalize(q.kind == QuadricKind::kSphere ? p : glm::dvec3(p.x, p.y, 0));
}

Point3 sample_uniform(const Quadric& q, const Point2& u) {
  const Point2 cs = cos_sin_turns(u.y * std::min(1.0f, q.phi_max / (2 * kPi)));
  const float z = q.z_min + u.x * (q.z_max - q.z_min);
  switch (q.kind) {
    case QuadricKind::kSphere: {
      const float r = std::sqrt(std::max(0.0f, (1 - z) * (1 + z)));
      return {r * cs.x, r * cs.y, z};
    }
    case QuadricKind::kCylinder:
      return {cs.x, cs.y, z};
    case QuadricKind::kDisk:
      break;
  }
  const float r = std::sqrt(q.inner * q.inner + u.x * (1 - q.inner * q.inner));
  return {r * cs.x, r * cs.y, 0};
}

// For cylinders, the map's inverse is rounded relative to the whole length, and the part of that error across
// the axis is amplified by the map across the axis.
float quadric_error(const Quadric& q) {
  const Transform& t = q.to_world;
  if (q.kind == QuadricKind::kSphere) return sphere_error(t);
  if (q.kind == QuadricKind::kDisk) return disk_error(t);
  glm::mat3 whole = t.linear, across = t.inverse_linear;
  whole[2] *= std::max(std::abs(q.z_min), std::abs(q.z_max));
  for (int c = 0; c < 3; ++c) across[c].z = 0;
  const float extent = max_row_sum(whole), amplified = max_row_sum(t.linear, 2) * max_row_sum(across);
  return surface_error(max_abs_component(t.translation) + extent, extent * std::max(1.0f, amplified));
}

// Maps the corners of the local box, which z_min and z_max cut but phi_max does not.
Bounds3 bounds_of(const Quadric& q) {
  const bool flat = q.kind == QuadricKind::kDisk;
  Bounds3 box;
  for (int corner = 0; corner < 8; ++corner) {
    const float z = flat ? 0 : corner & 4 ? q.z_max : q.z_min;
    box.add(q.to_world.point({corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, z}));
  }
  const float error = quadric_error(q);
  box.min -= error;
  box.max += error;
  return box;
}

// Integrates the area element |det M| |M^-T n| per local area. It depends smoothly on phi and z; the midpoint
// rule is exact for similarities, and along s for cylinders and disks.
double area_of(const Quadric& q) {
  constexpr int kRings = 128, kSectors = 256;
  const glm::dmat3 m(q.to_world.linear);
  const glm::dmat3 inverse_transpose = glm::transpose(glm::inverse(m));
  double mean = 0;
  for (int i = 0; i < kRings; ++i) {
    for (int j = 0; j < kSectors; ++j) {
      const glm::dvec3 p = point_at(q, (i + 0.5) / kRings, double(q.phi_max) * (j + 0.5) / kSectors);
      mean += glm::length(inverse_transpose * normal_at(q, p)) / (kRings * kSectors);
    }
  }
  const double inner = q.inner;
  const double local = q.kind == QuadricKind::kDisk ? 0.5 * (1 - inner * inner) : double(q.z_max - q.z_min);
  return std::abs(glm::determinant(m)) * mean * local * double(q.phi_max);
}

}  // namespace kaustik
