// Divides quadrics into triangles.

#include "core/geometry/tessellate.h"

#include <cmath>

namespace kaustik {
namespace {

constexpr int kAround = 96;  // per full turn

// The s of point_at() for t in [0, 1]. Spheres are divided evenly in the polar angle, so that the poles are
// as fine as the equator.
double place_along(const Quadric& q, double t) {
  if (q.kind != QuadricKind::kSphere) return t;
  const double low = double(q.z_min), high = double(q.z_max);
  const double z = std::cos(std::lerp(std::acos(low), std::acos(high), t));
  return std::clamp((z - low) / (high - low), 0.0, 1.0);
}

}  // namespace

TriangleMesh tessellated(const Shape& shape) {
  const auto found = quadric_of(shape);
  if (!found) return {};
  const Quadric& q = *found;
  const int up = q.kind == QuadricKind::kSphere ? kAround / 2 : 1;
  const int around = std::max(1, int(std::ceil(kAround * double(q.phi_max) / (2 * std::numbers::pi))));
  TriangleMesh mesh;
  for (int i = 0; i <= up; ++i) {
    for (int j = 0; j <= around; ++j) {
      const glm::dvec3 p = point_at(q, place_along(q, i / double(up)), double(q.phi_max) * j / around);
      const Normal3 n(glm::normalize(glm::dvec3(q.to_world.normal(Normal3(normal_at(q, p))))));
      mesh.P.push_back(q.to_world.point(Point3(p)));
      mesh.N.push_back(shape.flip_normal ? -n : n);
    }
  }
  const auto corner = [&](int i, int j) { return static_cast<uint32_t>(i * (around + 1) + j); };
  for (int i = 0; i < up; ++i) {
    for (int j = 0; j < around; ++j) {
      mesh.indices.push_back({corner(i, j), corner(i, j + 1), corner(i + 1, j + 1)});
      mesh.indices.push_back({corner(i, j), corner(i + 1, j + 1), corner(i + 1, j)});
    }
  }
  return mesh;
}

}  // namespace kaustik
