// Bounds and areas of shapes.

#include "core/geometry/shape.h"

#include "core/geometry/surface_bounds.h"

namespace kaustik {
namespace {

constexpr double kPiDouble = std::numbers::pi;

Bounds3 bounds_about(const Point3& center, const Vector3& half, float error) {
  Bounds3 b;
  b.add(center - half - error);
  b.add(center + half + error);
  return b;
}

// Half extent of the image of the unit disk (two columns) or ball (three): the root of the sum of squares of
// each row.
Vector3 half_extent(const glm::mat3& m, int columns) {
  glm::dvec3 sum(0);
  for (int c = 0; c < columns; ++c) sum += glm::dvec3(m[c]) * glm::dvec3(m[c]);
  return Vector3(glm::sqrt(sum));
}

Bounds3 bounds(const TriangleMesh& mesh) {
  Bounds3 b;
  for (const auto& triangle : mesh.indices) {
    for (const uint32_t i : triangle) b.add(mesh.P[i]);
  }
  return b;
}
Bounds3 bounds(const Sphere& s) {
  return bounds_about(s.to_world.translation, half_extent(s.to_world.linear, 3), sphere_error(s.to_world));
}
Bounds3 bounds(const Disk& d) {
  return bounds_about(d.to_world.translation, half_extent(d.to_world.linear, 2), disk_error(d.to_world));
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

// Integrates the area element of an ellipsoid, |det M| |M^-T n| per solid angle of the unit sphere. The
// integrand is smooth and periodic in phi, so the midpoint rule converges fast; it is exact for a round
// sphere.
double area(const Sphere& s) {
  constexpr int kRings = 128, kSectors = 64;
  const glm::dmat3 m(s.to_world.linear);
  const glm::dmat3 inverse_transpose = glm::transpose(glm::inverse(m));
  double sum = 0;
  for (int i = 0; i < kRings; ++i) {
    const double z = (2 * i + 1.0) / kRings - 1;
    const double r = std::sqrt(1 - z * z);
    for (int j = 0; j < kSectors; ++j) {
      const double phi = 2 * kPiDouble * (j + 0.5) / kSectors;
      sum += glm::length(inverse_transpose * glm::dvec3(r * std::cos(phi), r * std::sin(phi), z));
    }
  }
  return std::abs(glm::determinant(m)) * sum * 4 * kPiDouble / (kRings * kSectors);
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
Bounds3 bounds(const Quadric& q) {
  return bounds_of(q);
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
double area(const Quadric& q) {
  return area_of(q);
}

double area(const Disk& d) {
  const glm::dvec3 x(d.to_world.linear[0]);
  const glm::dvec3 y(d.to_world.linear[1]);
  const double inner = d.inner;
  return kPiDouble * (1 - inner * inner) * glm::length(glm::cross(x, y));
}

}  // namespace

std::optional<Quadric> quadric_of(const Shape& shape) {
  if (const auto* quadric = std::get_if<Quadric>(&shape.geometry)) return *quadric;
  if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) return Quadric{sphere->to_world};
  if (const auto* disk = std::get_if<Disk>(&shape.geometry))
    return Quadric{disk->to_world, QuadricKind::kDisk, 0, 0, disk->inner};
  return std::nullopt;
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
