#pragma once
// Error bounds and normals of triangles, also in instances. Intersections and lights share them, so that a
// ray leaves a surface by the same distance in both cases.

#include "core/geometry/shape.h"
#include "core/math/error_bounds.h"
#include "core/math/transform.h"

namespace kaustik {

// Error bound of the triangle point p = p0 + b1 e1 + b2 e2.
inline float triangle_error(const Point3& p, const Vector3& e1, const Vector3& e2) {
  return surface_error(max_abs_component(p), max_abs_component(e1) + max_abs_component(e2));
}

// Error bound of the image under to_world of p = p0 + b1 e1 + b2 e2, a point in an instance's own space. It
// adds up the errors of p, of the map (4 roundings) and of taking the ray to the instance's space. There the
// map's inverse, which is made from floats, is off by some 8 roundings times the map's condition number,
// amplified by the condition number on the way back; and its product with the origin rounds 5 times relative
// to world coordinates.
inline float instance_error(const Transform& to_world, const Point3& p, const Vector3& e1,
                            const Vector3& e2) {
  const float scale = max_row_sum(to_world.linear);
  const float condition = std::max(1.0f, scale * max_row_sum(to_world.inverse_linear));
  const float own = scale * max_abs_component(p);
  const float world = own + max_abs_component(to_world.translation);
  return scale * triangle_error(p, e1, e2) + gamma_bound(4) * world + gamma_bound(5) * condition * 2 * world +
         gamma_bound(8) * condition * condition * own;
}

// Unit normal along cross(e1, e2), computed in double because the squared length of a small triangle's cross
// product would underflow in float. Zero for a degenerate triangle.
inline Normal3 triangle_normal(const Vector3& e1, const Vector3& e2) {
  const glm::dvec3 n = glm::cross(glm::dvec3(e1), glm::dvec3(e2));
  const double length = glm::length(n);
  return length > 0 ? Normal3(n / length) : Normal3(0);
}

// The unit normal of a triangle's winding, or zero.
inline Normal3 winding_normal(const TriangleMesh& mesh, uint32_t triangle) {
  const auto [i0, i1, i2] = mesh.indices[triangle];
  return triangle_normal(mesh.P[i1] - mesh.P[i0], mesh.P[i2] - mesh.P[i0]);
}

// +1 or -1: the factor from the normal of a triangle's winding, in the mesh's own space, to the outside
// normal.
inline float outside_of(const TriangleMesh& mesh, const std::array<uint32_t, 3>& triangle,
                        const Normal3& winding, bool flip_normal) {
  if (mesh.N.empty()) return flip_normal ? -1.0f : 1.0f;
  const auto [i0, i1, i2] = triangle;
  return glm::dot(winding, mesh.N[i0] + mesh.N[i1] + mesh.N[i2]) < 0 ? -1.0f : 1.0f;
}

}  // namespace kaustik
