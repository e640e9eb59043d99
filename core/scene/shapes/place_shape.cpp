// Bakes transforms into shapes. Matrices are applied in double and the results rounded once.

#include "core/scene/shapes/shape_source.h"

namespace kaustik {
namespace {

// Whether the corners lie on one line, or so nearly that the normal is lost in floats. Products of float
// edges are exact in double, so the first test is exact; both tests are independent of scale.
bool has_no_area(const TriangleMesh& mesh, const std::array<uint32_t, 3>& t) {
  const Vector3 e1 = mesh.P[t[1]] - mesh.P[t[0]];
  const Vector3 e2 = mesh.P[t[2]] - mesh.P[t[0]];
  if (glm::cross(glm::dvec3(e1), glm::dvec3(e2)) == glm::dvec3(0)) return true;
  const Vector3 n = glm::cross(e1, e2);
  return n == Vector3(0) || !is_finite(n);
}

// Placements are copied while they have fewer triangles than this in total, or if the mesh is smaller than
// kSmallMesh.
constexpr uint64_t kCopiedTriangles = 1 << 16;
constexpr uint64_t kSmallMesh = 8;

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
    // The multiplication is skipped if it is by the identity, because it could change the sign of a zero.
    const bool moved = source.local != glm::dmat4(1);
    place_mesh(moved ? object_to_world * source.local : object_to_world, reverse_orientation, *mesh, placed);
    placed.shape.geometry = std::move(*mesh);
    // The cross product of the edges changes sign under a mirroring transform.
    placed.shape.flip_normal = reverse_orientation != (glm::determinant(glm::dmat3(object_to_world)) < 0);
    return placed;
  }
  std::visit(
      [&]<class G>(G& analytic) {
        if constexpr (AnalyticShape<G>) analytic.to_world = to_world;
      },
      source.geometry);
  placed.shape.geometry = std::move(source.geometry);
  // The normals of analytic shapes are transformed as normals, so the outside remains outside under
  // mirroring.
  placed.shape.flip_normal = reverse_orientation;
  placed.finite = to_world.invertible();
  return placed;
}

bool pays_to_share(const ShapeSource& source, size_t placements) {
  const auto* mesh = std::get_if<TriangleMesh>(&source.geometry);
  return mesh && placements > 1 && mesh->indices.size() >= kSmallMesh &&
         mesh->indices.size() * placements > kCopiedTriangles;
}

SharedMesh share_mesh(ShapeSource source, bool reverse_orientation) {
  auto& mesh = std::get<TriangleMesh>(source.geometry);
  PlacedShape placed;
  place_mesh(glm::dmat4(1), reverse_orientation, mesh, placed);
  SharedMesh shared;
  shared.local = source.local;
  shared.without_area = placed.without_area;
  shared.finite = placed.finite;
  for (const auto& triangle : mesh.indices)
    for (const uint32_t i : triangle) shared.instance.local.add(mesh.P[i]);
  shared.instance.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  return shared;
}

PlacedShape place_instance(const SharedMesh& shared, const glm::dmat4& object_to_world,
                           bool reverse_orientation) {
  PlacedShape placed;
  InstancedMesh instance = shared.instance;
  instance.to_world = Transform::from_matrix(object_to_world * shared.local);
  placed.without_area = shared.without_area;
  placed.finite = shared.finite && instance.to_world.invertible();
  placed.shape.geometry = std::move(instance);
  if (placed.finite && !shared.instance.local.empty()) {
    const Bounds3 bounds = bounds_of(placed.shape);
    placed.finite = is_finite(bounds.min) && is_finite(bounds.max);
  }
  // Normals are transformed as normals, so the outside remains outside under mirroring.
  placed.shape.flip_normal = reverse_orientation;
  return placed;
}

}  // namespace kaustik
