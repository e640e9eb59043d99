#pragma once
// Shapes and lights made in code.

#include <stdexcept>

#include "core/scene/scene.h"

namespace kaustik::test {

inline glm::dmat4 affine(const glm::dmat3& linear, const glm::dvec3& translation) {
  glm::dmat4 m(linear);
  m[3] = glm::dvec4(translation, 1);
  return m;
}

inline Shape mesh_shape(TriangleMesh mesh, uint32_t material = 0) {
  Shape shape;
  shape.geometry = std::move(mesh);
  shape.material = material;
  return shape;
}

// The outside of a triangle or quad is the side of (p1 - p0) x (p2 - p0).
inline Shape triangle(const Point3& p0, const Point3& p1, const Point3& p2, uint32_t material = 0) {
  return mesh_shape(TriangleMesh{{p0, p1, p2}, {}, {}, {{0, 1, 2}}}, material);
}
inline Shape quad(const Point3& p0, const Point3& p1, const Point3& p2, const Point3& p3, uint32_t material) {
  return mesh_shape(TriangleMesh{{p0, p1, p2, p3}, {}, {}, {{0, 1, 2}, {0, 2, 3}}}, material);
}
// Outside is the side of a x b.
inline Shape parallelogram(const Point3& corner, const Vector3& a, const Vector3& b, uint32_t material = 0) {
  return quad(corner, corner + a, corner + a + b, corner + b, material);
}

inline Shape sphere(const Point3& center, float radius, uint32_t material = 0, bool inward = false) {
  Shape shape;
  shape.geometry = Sphere{Transform::from_matrix(affine(glm::dmat3(double(radius)), glm::dvec3(center)))};
  shape.material = material;
  shape.flip_normal = inward;
  return shape;
}

// A square of n x n cells, two triangles each, that faces up. z(x, y): the heights of its vertices, which are
// asked for row by row.
template <class Height>
TriangleMesh terrain(uint32_t n, const Height& z) {
  TriangleMesh mesh;
  for (uint32_t y = 0; y <= n; ++y)
    for (uint32_t x = 0; x <= n; ++x) mesh.P.emplace_back(float(x), float(y), z(x, y));
  for (uint32_t y = 0; y < n; ++y)
    for (uint32_t x = 0; x < n; ++x) {
      const uint32_t at = y * (n + 1) + x;
      mesh.indices.push_back({at, at + 1, at + n + 2});
      mesh.indices.push_back({at, at + n + 2, at + n + 1});
    }
  return mesh;
}

// The wall of a tube about z with open ends, its middle at the origin; its facets face outwards.
inline Shape tube(float radius, float length, int sides, int rings) {
  TriangleMesh mesh;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < sides; ++j) {
      const float phi = 2 * kPi * float(j) / float(sides);
      mesh.P.push_back(
          {radius * std::cos(phi), radius * std::sin(phi), length * (float(i) / float(rings) - 0.5f)});
    }
  const auto corner = [&](int i, int j) { return static_cast<uint32_t>(i * sides + j % sides); };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < sides; ++j) {
      mesh.indices.push_back({corner(i, j), corner(i, j + 1), corner(i + 1, j + 1)});
      mesh.indices.push_back({corner(i, j), corner(i + 1, j + 1), corner(i + 1, j)});
    }
  return mesh_shape(std::move(mesh));
}

// Makes `shape` emit radiance L. It must become a shape of the scene.
inline void make_light(Scene& scene, Shape& shape, const Rgb& L, bool twosided = false) {
  auto light = DiffuseAreaLight::make(shape, L, twosided);
  if (!light) throw std::logic_error("this shape cannot emit");
  shape.light = static_cast<uint32_t>(scene.lights.size());
  scene.lights.push_back(*light);
}

}  // namespace kaustik::test
