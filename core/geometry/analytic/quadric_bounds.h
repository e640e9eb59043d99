#pragma once
// Error bounds, normals and extents of spheres and disks. Intersections and lights share them, so that a ray
// leaves a surface by the same distance in both cases.

#include "core/math/bounds.h"
#include "core/math/error_bounds.h"
#include "core/math/transform.h"

namespace kaustik {

// Error bound of a point on a round sphere.
inline float sphere_error(const Point3& center, float radius) {
  return surface_error(max_abs_component(center) + radius, 2 * radius);
}

// Error bound of a point on the image of the unit sphere. The intersector works in object space, where the
// rounding of the inverse is amplified by the condition number of the map.
inline float sphere_error(const Transform& to_world) {
  const float extent = max_row_sum(to_world.linear);
  const float condition = extent * max_row_sum(to_world.inverse_linear);
  return surface_error(max_abs_component(to_world.translation) + extent, extent * std::max(1.0f, condition));
}

// Error bound of a point on the image of the unit disk.
inline float disk_error(const Transform& to_world) {
  const float extent = max_row_sum(to_world.linear, 2);
  return surface_error(max_abs_component(to_world.translation) + extent, 2 * extent);
}

// +z mapped as a normal, with unit length.
inline Normal3 disk_normal(const Transform& to_world) {
  return Normal3(glm::normalize(glm::dvec3(to_world.normal({0, 0, 1}))));
}

inline Bounds3 bounds_about(const Point3& center, const Vector3& half, float error) {
  Bounds3 b;
  b.add(center - half - error);
  b.add(center + half + error);
  return b;
}

// Half extent of the image of the unit disk (two columns) or ball (three): the root of the sum of squares of
// each row.
inline Vector3 half_extent(const glm::mat3& m, int columns) {
  glm::dvec3 sum(0);
  for (int c = 0; c < columns; ++c) sum += glm::dvec3(m[c]) * glm::dvec3(m[c]);
  return Vector3(glm::sqrt(sum));
}

}  // namespace kaustik
