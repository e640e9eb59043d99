#pragma once
// Example values of every analytic shape. All tests that hold for any of them run over these. A shape without
// examples does not compile: "use of deleted function".

#include <vector>

#include "core/geometry/shape.h"

namespace kaustik::test {

// Turned, mirrored and scaled unevenly; the middle of the shape lies at (0.3, -0.2, 0.5).
inline Transform uneven_placement() {
  glm::dmat4 m(1);
  m[0] = {0.4, 0.3, 0, 0};
  m[1] = {0.2, -0.5, 0.1, 0};
  m[2] = {0.1, 0.1, 0.6, 0};
  m[3] = {0.3, -0.2, 0.5, 1};
  return Transform::from_matrix(m);
}

// The examples should show every kind that the type can have, whole and cut, under even and uneven scales.
template <AnalyticShape G>
std::vector<G> shape_examples() = delete;

template <>
inline std::vector<Sphere> shape_examples() {
  return {{Transform()}, {uneven_placement()}};
}
template <>
inline std::vector<Disk> shape_examples() {
  return {{Transform(), 0}, {uneven_placement(), 0.4f}};
}
template <>
inline std::vector<Quadric> shape_examples() {
  std::vector<Quadric> all;
  for (const Transform& to_world : {Transform(), uneven_placement()}) {
    for (const QuadricKind kind : {QuadricKind::kSphere, QuadricKind::kCylinder, QuadricKind::kDisk}) {
      const float inner = kind == QuadricKind::kDisk ? 0.3f : 0.0f;
      all.push_back({to_world, kind, -0.6f, 0.8f, inner});
      all.push_back({to_world, kind, -0.6f, 0.8f, inner, 4});
    }
  }
  return all;
}

namespace detail {
template <class G>
void add_examples(std::vector<Shape>& all) {
  if constexpr (AnalyticShape<G>) {
    for (const G& g : shape_examples<G>()) all.emplace_back().geometry = g;
  }
}
template <class... G>
std::vector<Shape> examples_of_all(const std::variant<G...>* /*deduces G*/) {
  std::vector<Shape> all;
  (add_examples<G>(all), ...);
  return all;
}
}  // namespace detail

// The examples of all analytic alternatives of Geometry, in the order of the list.
inline const std::vector<Shape>& analytic_shapes() {
  static const std::vector<Shape> all = detail::examples_of_all(static_cast<const Geometry*>(nullptr));
  return all;
}

}  // namespace kaustik::test
