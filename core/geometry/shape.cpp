// Bounds and areas of shapes.

#include "core/geometry/shape.h"

#include "core/geometry/triangle_bounds.h"

namespace kaustik {
namespace {

Bounds3 bounds(const TriangleMesh& mesh) {
  Bounds3 b;
  for (const auto& triangle : mesh.indices) {
    for (const uint32_t i : triangle) b.add(mesh.P[i]);
  }
  return b;
}

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& [i0, i1, i2] : mesh.indices) {
    const glm::dvec3 e1(mesh.P[i1] - mesh.P[i0]);
    const glm::dvec3 e2(mesh.P[i2] - mesh.P[i0]);
    sum += 0.5 * glm::length(glm::cross(e1, e2));
  }
  return sum;
}

// Bounds of the corners of the mapped local box: larger than necessary, but found without visiting the
// triangles.
Bounds3 bounds(const InstancedMesh& instance) {
  const Bounds3& local = instance.local;
  Bounds3 b;
  if (local.empty()) return b;
  float error = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Point3 p(corner & 1 ? local.max.x : local.min.x, corner & 2 ? local.max.y : local.min.y,
                   corner & 4 ? local.max.z : local.min.z);
    b.add(instance.to_world.point(p));
    error = std::max(error, instance_error(instance.to_world, p, Vector3(0), Vector3(0)));
  }
  b.min -= error;
  b.max += error;
  return b;
}

double area(const InstancedMesh& instance) {
  double sum = 0;
  const glm::dmat3 m(instance.to_world.linear);
  for (const auto& [i0, i1, i2] : instance.mesh->indices) {
    const glm::dvec3 p0(instance.mesh->P[i0]);
    sum += 0.5 * glm::length(glm::cross(m * (glm::dvec3(instance.mesh->P[i1]) - p0),
                                        m * (glm::dvec3(instance.mesh->P[i2]) - p0)));
  }
  return sum;
}

template <AnalyticShape G>
Bounds3 bounds(const G& analytic) {
  return analytic.bounds();
}
template <AnalyticShape G>
double area(const G& analytic) {
  return analytic.area();
}

}  // namespace

std::optional<SweptGeometry> swept_of(const Shape& shape) {
  return std::visit(
      []<class G>(const G& g) -> std::optional<SweptGeometry> {
        if constexpr (AnalyticShape<G>) return g.swept();
        return std::nullopt;
      },
      shape.geometry);
}

std::string_view name_of(const Shape& shape) {
  return std::visit([]<class G>(const G&) -> std::string_view { return G::kName; }, shape.geometry);
}

Bounds3 bounds_of(const Shape& shape) {
  return std::visit([](const auto& g) { return bounds(g); }, shape.geometry);
}

double surface_area(const Shape& shape) {
  return std::visit([](const auto& g) { return area(g); }, shape.geometry);
}

uint64_t primitive_count(const Shape& shape) {
  const TriangleMesh* mesh = shape.mesh();
  return mesh ? mesh->indices.size() : 1;
}

}  // namespace kaustik
