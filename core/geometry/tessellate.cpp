// Divides quadrics into triangles.

#include "core/geometry/tessellate.h"

#include <cmath>
#include <utility>

namespace kaustik {
namespace {

// Pieces along the axis and about it.
template <SweptShape S>
std::pair<int, int> pieces_of(const S& q, int around) {
  return {q.strips(around), std::max(1, int(std::ceil(around * q.turn() / (2 * std::numbers::pi))))};
}

template <SweptShape S>
TriangleMesh tessellate(const S& q, bool flip_normal, int per_turn) {
  const auto [strips, sectors] = pieces_of(q, per_turn);
  const int up = strips, around = sectors;  // lambdas capture no structured bindings
  TriangleMesh mesh;
  for (int i = 0; i <= up; ++i) {
    for (int j = 0; j <= around; ++j) {
      const glm::dvec3 p = q.point_at(q.strip_at(i / double(up)), q.turn() * j / around);
      const Normal3 n(glm::normalize(glm::dvec3(q.to_world.normal(Normal3(q.normal_at(p))))));
      mesh.P.push_back(q.to_world.point(Point3(p)));
      mesh.N.push_back(flip_normal ? -n : n);
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

}  // namespace

TriangleMesh tessellated(const Shape& shape, int around) {
  const auto swept = swept_of(shape);
  if (!swept) return {};
  return std::visit([&](const auto& s) { return tessellate(s, shape.flip_normal, around); }, *swept);
}

uint64_t triangle_count(const Shape& shape, int around) {
  const auto swept = swept_of(shape);
  if (!swept) return primitive_count(shape);
  const auto [up, sectors] = std::visit([&](const auto& s) { return pieces_of(s, around); }, *swept);
  return uint64_t{2} * uint64_t(up) * uint64_t(sectors);
}

}  // namespace kaustik
