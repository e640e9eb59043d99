// Intersection, sampling, bounds and area of quadrics.

#include "core/geometry/analytic/quadric.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/analytic/quadric_bounds.h"
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

float Quadric::intersect(const Ray& ray, Point2* uv) const {
  const Point3 o = to_world.inverse_point(ray.o);
  const Vector3 d = to_world.inverse_vector(ray.d);
  return kind == QuadricKind::kDisk ? intersect_flat(*this, o, d, ray.t_max, uv)
                                    : intersect_round(*this, o, d, ray.t_max);
}

SurfacePoint Quadric::at_hit(const Ray& ray, float t, const Point2& uv) const {
  Point3 p(uv.x, uv.y, 0);
  if (!flat()) p = to_world.inverse_point(ray.o) + t * to_world.inverse_vector(ray.d);
  const Normal3 local(normal_at(glm::dvec3(p)));
  // Back to the surface: the error of the ray's length remains only along the surface.
  if (kind == QuadricKind::kSphere) p = local;
  if (kind == QuadricKind::kCylinder) p = {local.x, local.y, p.z};
  return {to_world.point(p), error(), unit_vector(to_world.normal(local))};
}

glm::dvec3 Quadric::point_at(double s, double phi) const {
  const double z = double(z_min) + s * double(z_max - z_min), hole = inner;
  switch (kind) {
    case QuadricKind::kSphere: {
      const double r = std::sqrt(std::max(0.0, 1 - z * z));
      return {r * std::cos(phi), r * std::sin(phi), z};
    }
    case QuadricKind::kCylinder:
      return {std::cos(phi), std::sin(phi), z};
    case QuadricKind::kDisk:
      break;
  }
  const double r = hole + s * (1 - hole);
  return {r * std::cos(phi), r * std::sin(phi), 0};
}

glm::dvec3 Quadric::normal_at(const glm::dvec3& p) const {
  if (kind == QuadricKind::kDisk) return {0, 0, 1};
  const glm::dvec3 across = kind == QuadricKind::kSphere ? p : glm::dvec3(p.x, p.y, 0);
  return across == glm::dvec3(0) ? glm::dvec3(1, 0, 0) : glm::normalize(across);
}

Point3 Quadric::sample_uniform(const Point2& u) const {
  const Point2 cs = cos_sin_turns(u.y * std::min(1.0f, phi_max / (2 * kPi)));
  const float z = z_min + u.x * (z_max - z_min);
  switch (kind) {
    case QuadricKind::kSphere: {
      const float r = std::sqrt(std::max(0.0f, (1 - z) * (1 + z)));
      return {r * cs.x, r * cs.y, z};
    }
    case QuadricKind::kCylinder:
      return {cs.x, cs.y, z};
    case QuadricKind::kDisk:
      break;
  }
  const float r = std::sqrt(inner * inner + u.x * (1 - inner * inner));
  return {r * cs.x, r * cs.y, 0};
}

// For cylinders, the map's inverse is rounded relative to the whole length, and the part of that error across
// the axis is amplified by the map across the axis.
float Quadric::error() const {
  const Transform& t = to_world;
  if (kind == QuadricKind::kSphere) return sphere_error(t);
  if (kind == QuadricKind::kDisk) return disk_error(t);
  glm::mat3 whole = t.linear, across = t.inverse_linear;
  whole[2] *= std::max(std::abs(z_min), std::abs(z_max));
  for (int c = 0; c < 3; ++c) across[c].z = 0;
  const float extent = max_row_sum(whole), amplified = max_row_sum(t.linear, 2) * max_row_sum(across);
  return surface_error(max_abs_component(t.translation) + extent, extent * std::max(1.0f, amplified));
}

// Maps the corners of the local box, which z_min and z_max cut but phi_max does not.
Bounds3 Quadric::bounds() const {
  Bounds3 box;
  for (int corner = 0; corner < 8; ++corner) {
    const float z = flat() ? 0 : corner & 4 ? z_max : z_min;
    box.add(to_world.point({corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, z}));
  }
  const float room = error();
  box.min -= room;
  box.max += room;
  return box;
}

// Integrates the area element |det M| |M^-T n| per local area. It depends smoothly on phi and z, and on
// neither of them where areas keep even; on cylinders it does not depend on z.
double Quadric::area() const {
  const bool even = keeps_areas_even();
  const int rings = even || kind == QuadricKind::kCylinder ? 1 : 128, sectors = even ? 1 : 256;
  const glm::dmat3 m(to_world.linear);
  const glm::dmat3 inverse_transpose = glm::transpose(glm::inverse(m));
  double mean = 0;
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < sectors; ++j) {
      const glm::dvec3 p = point_at((i + 0.5) / rings, double(phi_max) * (j + 0.5) / sectors);
      mean += glm::length(inverse_transpose * normal_at(p)) / (rings * sectors);
    }
  }
  const double hole = inner;
  const double local = kind == QuadricKind::kDisk ? 0.5 * (1 - hole * hole) : double(z_max - z_min);
  return std::abs(glm::determinant(m)) * mean * local * double(phi_max);
}

Bounds3 Quadric::local_bounds() const {
  const bool cylinder = kind == QuadricKind::kCylinder;
  return {{-1, -1, cylinder ? z_min : -1}, {1, 1, cylinder ? z_max : 1}};
}

// Even in the polar angle of a sphere, so that the poles are as fine as the equator.
double Quadric::strip_at(double t) const {
  if (kind != QuadricKind::kSphere) return t;
  const double low = double(z_min), high = double(z_max);
  const double z = std::cos(std::lerp(std::acos(low), std::acos(high), t));
  return std::clamp((z - low) / (high - low), 0.0, 1.0);
}

bool Quadric::has_rim(int end) const {
  const bool sphere = kind == QuadricKind::kSphere;
  if (end == 0) return !(sphere && z_min <= -1) && !(flat() && inner == 0);
  return !(sphere && z_max >= 1);
}

// An ellipsoid counts as a ball of its mean radius.
double Quadric::bend(double surface_area) const {
  if (flat()) return 0;
  const bool ball = kind == QuadricKind::kSphere;
  const glm::dmat3 m(to_world.linear);
  const double radius =
      ball ? std::cbrt(std::abs(glm::determinant(m))) : std::sqrt(glm::length(glm::cross(m[0], m[1])));
  return radius > 0 ? (ball ? 2 : 1) * surface_area / radius : 0;
}

LocalParameters Quadric::parameters(const Point3& on_surface) const {
  Point3 p = kind == QuadricKind::kSphere ? glm::normalize(on_surface) : on_surface;
  constexpr float kNearAxis = 1e-5f;
  if (p.x == 0 && p.y == 0) p.x = kNearAxis;
  const float r = std::sqrt(p.x * p.x + p.y * p.y);
  const Vector3 outward(p.x / r, p.y / r, 0), along(-p.y, p.x, 0);
  float phi = std::atan2(p.y, p.x);
  if (phi < 0) phi += 2 * kPi;
  LocalParameters s;
  s.uv.x = phi / phi_max;
  s.dpdu = phi_max * along;
  switch (kind) {
    case QuadricKind::kSphere: {
      // polar angle theta at v = 0, and its change to v = 1
      const float low = std::acos(z_min), turn = std::acos(z_max) - low;
      s.uv.y = (std::atan2(r, p.z) - low) / turn;
      s.dpdv = turn * (p.z * outward - Vector3(0, 0, r));
      s.n = p;
      s.dndu = s.dpdu;
      s.dndv = s.dpdv;
      return s;
    }
    case QuadricKind::kCylinder:
      s.uv.y = (p.z - z_min) / (z_max - z_min);
      s.dpdv = {0, 0, z_max - z_min};
      s.n = outward;
      s.dndu = s.dpdu;
      return s;
    case QuadricKind::kDisk:
      break;
  }
  s.uv.y = (1 - r) / (1 - inner);
  s.dpdv = (inner - 1) * outward;
  return s;
}

bool Quadric::keeps_areas_even() const {
  if (kind == QuadricKind::kDisk) return true;
  glm::mat3 m = to_world.linear;
  // A cylinder may be scaled along its axis.
  if (kind == QuadricKind::kCylinder) m[2] *= glm::length(m[0]) / glm::length(m[2]);
  return is_similarity(m);
}

Point2 Quadric::square_of(const Point3& p) const {
  float phi = std::atan2(p.y, p.x);
  if (phi < 0) phi += 2 * kPi;
  const float inner2 = inner * inner;
  const float along = kind == QuadricKind::kDisk ? (p.x * p.x + p.y * p.y - inner2) / (1 - inner2)
                                                 : (p.z - z_min) / (z_max - z_min);
  return {along, phi / phi_max};
}

float Quadric::v_of(float u) const {
  switch (kind) {
    case QuadricKind::kSphere: {
      const float low = std::acos(z_min), turn = std::acos(z_max) - low;
      return (std::acos(std::clamp(z_min + u * (z_max - z_min), -1.0f, 1.0f)) - low) / turn;
    }
    case QuadricKind::kCylinder:
      return u;
    case QuadricKind::kDisk:
      break;
  }
  return (1 - std::sqrt(inner * inner + u * (1 - inner * inner))) / (1 - inner);
}

}  // namespace kaustik
