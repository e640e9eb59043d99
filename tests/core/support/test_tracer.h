#pragma once
// Finds the nearest hit by trying every primitive, without a BVH; triangles in double.

#include <glm/glm.hpp>

#include "core/geometry/interaction.h"

namespace kaustik::test {

inline void try_triangle(const TriangleMesh& mesh, uint32_t primitive, const Ray& ray, Hit& best,
                         uint32_t shape) {
  const auto& [i0, i1, i2] = mesh.indices[primitive];
  const glm::dvec3 p0(mesh.P[i0]), e1 = glm::dvec3(mesh.P[i1]) - p0, e2 = glm::dvec3(mesh.P[i2]) - p0;
  const glm::dvec3 d(ray.d), s = glm::dvec3(ray.o) - p0;
  const glm::dvec3 h = glm::cross(d, e2), q = glm::cross(s, e1);
  const double det = glm::dot(e1, h);
  if (det == 0) return;
  const double u = glm::dot(s, h) / det, v = glm::dot(d, q) / det, t = glm::dot(e2, q) / det;
  if (!(u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < ray.t_max && t < best.t)) return;
  best = {static_cast<float>(t), shape, primitive, {static_cast<float>(u), static_cast<float>(v)}};
}

inline Hit brute_force(const std::vector<Shape>& shapes, const Ray& ray) {
  Hit best;
  for (uint32_t s = 0; s < shapes.size(); ++s) {
    if (const auto* mesh = std::get_if<TriangleMesh>(&shapes[s].geometry)) {
      for (uint32_t i = 0; i < mesh->indices.size(); ++i) try_triangle(*mesh, i, ray, best, s);
      continue;
    }
    Hit hit;
    hit.shape = s;
    std::visit(
        [&]<class G>(const G& g) {
          if constexpr (AnalyticShape<G>) hit.t = g.intersect(ray, &hit.uv);
        },
        shapes[s].geometry);
    if (hit.t < best.t) best = hit;
  }
  return best;
}

}  // namespace kaustik::test
