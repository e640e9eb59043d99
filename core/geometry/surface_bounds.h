#pragma once
// Error bounds and normals of the three kinds of surface, shared by intersections and lights so that a point
// leaves a surface by the same distance whichever of them made it.

#include "core/geometry/shape.h"
#include "core/math/error_bounds.h"

namespace kaustik {

// Largest sum of absolute values in a row of the first `columns` columns: bounds the coordinates of the image
// of the unit box.
inline float max_row_sum(const glm::mat3& m, int columns = 3) {
  Vector3 sum(0);
  for (int c = 0; c < columns; ++c) sum += glm::abs(m[c]);
  return max_component(sum);
}

// Of p = p0 + b1 e1 + b2 e2.
inline float triangle_error(const Point3& p, const Vector3& e1, const Vector3& e2) {
  return surface_error(max_abs_component(p), max_abs_component(e1) + max_abs_component(e2));
}

// Of the image of p = p0 + b1 e1 + b2 e2, a point of an instance's own space, under to_world. To the errors
// of p and of the map (4 roundings) comes that of taking the ray to the instance's space: the map's inverse
// is made from floats, so it is off by some 8 roundings times the map's condition, amplified by the condition
// on its way back; and its product with the origin rounds relative to coordinates in the world, 5 times.
inline float instance_error(const Transform& to_world, const Point3& p, const Vector3& e1,
                            const Vector3& e2) {
  const float scale = max_row_sum(to_world.linear);
  const float condition = std::max(1.0f, scale * max_row_sum(to_world.inverse_linear));
  const float own = scale * max_abs_component(p);
  const float world = own + max_abs_component(to_world.translation);
  return scale * triangle_error(p, e1, e2) + gamma_bound(4) * world + gamma_bound(5) * condition * 2 * world +
         gamma_bound(8) * condition * condition * own;
}

// Of a point on a round sphere.
inline float sphere_error(const Point3& center, float radius) {
  return surface_error(max_abs_component(center) + radius, 2 * radius);
}

// Of a point on the image of the unit sphere. The intersector works in object space, where the rounding of
// the inverse is amplified by the condition number of the map.
inline float sphere_error(const Transform& to_world) {
  const float extent = max_row_sum(to_world.linear);
  const float condition = extent * max_row_sum(to_world.inverse_linear);
  return surface_error(max_abs_component(to_world.translation) + extent, extent * std::max(1.0f, condition));
}

// Of a point on the image of the unit disk.
inline float disk_error(const Transform& to_world) {
  const float extent = max_row_sum(to_world.linear, 2);
  return surface_error(max_abs_component(to_world.translation) + extent, 2 * extent);
}

// Unit normal of cross(e1, e2), in double: the squared length of a small triangle's cross product would
// underflow in float. Zero for a degenerate triangle.
inline Normal3 triangle_normal(const Vector3& e1, const Vector3& e2) {
  const glm::dvec3 n = glm::cross(glm::dvec3(e1), glm::dvec3(e2));
  const double length = glm::length(n);
  return length > 0 ? Normal3(n / length) : Normal3(0);
}

// +1 or -1: from the normal of a triangle's winding, in the mesh's own space, to that of the outside.
inline float outside_of(const TriangleMesh& mesh, const std::array<uint32_t, 3>& triangle,
                        const Normal3& winding, bool flip_normal) {
  if (mesh.N.empty()) return flip_normal ? -1.0f : 1.0f;
  const auto [i0, i1, i2] = triangle;
  return glm::dot(winding, mesh.N[i0] + mesh.N[i1] + mesh.N[i2]) < 0 ? -1.0f : 1.0f;
}

// +z mapped as a normal, unit.
inline Normal3 disk_normal(const Transform& to_world) {
  return Normal3(glm::normalize(glm::dvec3(to_world.normal({0, 0, 1}))));
}

}  // namespace kaustik
