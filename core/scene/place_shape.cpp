// Transforms baked into shapes. Matrices are applied in double and rounded once.

#include "core/scene/shape_source.h"

namespace kaustik {
namespace {

// The corners lie on one line, or so nearly that the normal is lost in floats. Edges of floats have exact
// products in double, so the first test is exact; both are free of scale.
bool has_no_area(const TriangleMesh& mesh, const std::array<uint32_t, 3>& t) {
  const Vector3 e1 = mesh.P[t[1]] - mesh.P[t[0]];
  const Vector3 e2 = mesh.P[t[2]] - mesh.P[t[0]];
  if (glm::cross(glm::dvec3(e1), glm::dvec3(e2)) == glm::dvec3(0)) return true;
  const Vector3 n = glm::cross(e1, e2);
  return n == Vector3(0) || !is_finite(n);
}

void place_mesh(const glm::dmat4& m, bool reverse_orientation, TriangleMesh& mesh, PlacedShape& placed) {
  if (m != glm::dmat4(1)) {
    for (Point3& p : mesh.P) p = Point3(m * glm::dvec4(p, 1));
  }
  const glm::dmat3 normal_matrix = glm::transpose(glm::inverse(glm::dmat3(m)));
  for (Normal3& n : mesh.N) {
    const glm::dvec3 world = normal_matrix * glm::dvec3(n);
    const double length = glm::length(world);
    n = length > 0 ? Normal3((reverse_orientation ? -world : world) / length) : Normal3(0);
  }
  const size_t before = mesh.indices.size();
  for (const Point3& p : mesh.P) placed.finite = placed.finite && is_finite(p);
  if (placed.finite) std::erase_if(mesh.indices, [&](const auto& t) { return has_no_area(mesh, t); });
  placed.without_area = before - mesh.indices.size();
}

}  // namespace

PlacedShape place_shape(ShapeSource source, const glm::dmat4& object_to_world, bool reverse_orientation) {
  PlacedShape placed;
  const Transform to_world = Transform::from_matrix(object_to_world * source.local);
  if (auto* mesh = std::get_if<TriangleMesh>(&source.geometry)) {
    // A product with the identity could change the sign of a zero.
    const bool moved = source.local != glm::dmat4(1);
    place_mesh(moved ? object_to_world * source.local : object_to_world, reverse_orientation, *mesh, placed);
    placed.shape.geometry = std::move(*mesh);
    // The cross product of the edges turns over when the transform mirrors.
    placed.shape.flip_normal = reverse_orientation != (glm::determinant(glm::dmat3(object_to_world)) < 0);
    return placed;
  }
  if (const auto* disk = std::get_if<DiskSource>(&source.geometry)) {
    placed.shape.geometry = Disk{to_world, disk->inner};
  } else {
    placed.shape.geometry = Sphere{to_world};
  }
  // Their normals are mapped as normals, which keeps the outside outside under mirroring, too.
  placed.shape.flip_normal = reverse_orientation;
  placed.finite = to_world.invertible();
  return placed;
}

}  // namespace kaustik
