// Texture coordinates and their derivatives on triangles and quadrics, as in pbrt-v4.

#include "core/geometry/surface_parameters.h"

namespace kaustik {

namespace {

constexpr float k2Pi = 2 * kPi;

// Solves for the derivatives by u and v of a quantity that changes by d1 and d2 along two edges of a
// triangle.
struct UvSystem {
  Vector2 duv1, duv2;
  float determinant = 0;

  bool regular() const { return determinant != 0 && std::isfinite(1 / determinant); }
  Vector3 per_u(const Vector3& d1, const Vector3& d2) const {
    return (duv2.y * d1 - duv1.y * d2) / determinant;
  }
  Vector3 per_v(const Vector3& d1, const Vector3& d2) const {
    return (duv1.x * d2 - duv2.x * d1) / determinant;
  }
};

// Derivative of the normalised normal from derivative d of the interpolated one; the part along n only
// changes the length.
Vector3 turning(const Vector3& d, const Normal3& n, float length) {
  return (d - glm::dot(n, d) * n) / length;
}

// to_world and normal_to_world map vectors and normals of the mesh to world space.
template <class Vectors, class Normals>
SurfaceParameters of_triangle(const TriangleMesh& mesh, const SurfaceInteraction& si, Vectors&& to_world,
                              Normals&& normal_to_world) {
  const auto [i0, i1, i2] = mesh.indices[si.primitive];
  std::array<Point2, 3> uv{Point2(0, 0), Point2(1, 0), Point2(1, 1)};
  if (!mesh.uv.empty()) uv = {mesh.uv[i0], mesh.uv[i1], mesh.uv[i2]};
  const float b1 = si.hit_uv.x, b2 = si.hit_uv.y;
  const Vector3 e1 = to_world(mesh.P[i1] - mesh.P[i0]), e2 = to_world(mesh.P[i2] - mesh.P[i0]);
  UvSystem system{uv[1] - uv[0], uv[2] - uv[0]};
  system.determinant = system.duv1.x * system.duv2.y - system.duv1.y * system.duv2.x;
  SurfaceParameters s;
  s.uv = uv[0] + (b1 * system.duv1 + b2 * system.duv2);
  if (system.regular()) {
    s.dpdu = system.per_u(e1, e2);
    s.dpdv = system.per_v(e1, e2);
  }
  if (!system.regular() || !(length_squared(glm::cross(s.dpdu, s.dpdv)) > 0)) {
    const Frame frame = Frame::from_z(si.n);
    const float scale = glm::length(e1);
    s.dpdu = scale * frame.x;
    s.dpdv = scale * frame.y;
    return s;
  }
  if (mesh.N.empty() || si.ns == si.n) return s;
  const Normal3 ns = normal_to_world((1 - b1 - b2) * mesh.N[i0] + b1 * mesh.N[i1] + b2 * mesh.N[i2]);
  const Vector3 n1 = normal_to_world(mesh.N[i1] - mesh.N[i0]);
  const Vector3 n2 = normal_to_world(mesh.N[i2] - mesh.N[i0]);
  const float length = glm::length(ns);
  s.dndu = turning(system.per_u(n1, n2), si.ns, length);
  s.dndv = turning(system.per_v(n1, n2), si.ns, length);
  return s;
}

SurfaceParameters parameters(const TriangleMesh& mesh, const Shape& /*shape*/, const SurfaceInteraction& si) {
  const auto same = [](const Vector3& v) { return v; };
  return of_triangle(mesh, si, same, same);
}

SurfaceParameters parameters(const InstancedMesh& instance, const Shape& /*shape*/,
                             const SurfaceInteraction& si) {
  const Transform& t = instance.to_world;
  return of_triangle(
      *instance.mesh, si, [&](const Vector3& v) { return t.vector(v); },
      [&](const Normal3& n) { return t.normal(n); });
}

// Parametrisation in the space of the unit sphere, cylinder or disk.
struct LocalParameters {
  Point2 uv{0};
  Vector3 dpdu{0}, dpdv{0};
  Normal3 n{0, 0, 1};
  Vector3 dndu{0}, dndv{0};
};

LocalParameters local_parameters(const Quadric& q, Point3 p) {
  constexpr float kNearAxis = 1e-5f;
  if (p.x == 0 && p.y == 0) p.x = kNearAxis;
  const float r = std::sqrt(p.x * p.x + p.y * p.y);
  const Vector3 outward(p.x / r, p.y / r, 0), along(-p.y, p.x, 0);
  float phi = std::atan2(p.y, p.x);
  if (phi < 0) phi += k2Pi;
  LocalParameters s;
  s.uv.x = phi / q.phi_max;
  s.dpdu = q.phi_max * along;
  switch (q.kind) {
    case QuadricKind::kSphere: {
      // polar angle theta at v = 0, and its change to v = 1
      const float low = std::acos(q.z_min), turn = std::acos(q.z_max) - low;
      s.uv.y = (std::atan2(r, p.z) - low) / turn;
      s.dpdv = turn * (p.z * outward - Vector3(0, 0, r));
      s.n = p;
      s.dndu = s.dpdu;
      s.dndv = s.dpdv;
      return s;
    }
    case QuadricKind::kCylinder:
      s.uv.y = (p.z - q.z_min) / (q.z_max - q.z_min);
      s.dpdv = {0, 0, q.z_max - q.z_min};
      s.n = outward;
      s.dndu = s.dpdu;
      return s;
    case QuadricKind::kDisk:
      break;
  }
  s.uv.y = (1 - r) / (1 - q.inner);
  s.dpdv = (q.inner - 1) * outward;
  return s;
}

SurfaceParameters parameters(const Quadric& q, const Shape& shape, const SurfaceInteraction& si) {
  const Transform& t = q.to_world;
  Point3 p(si.hit_uv, 0);
  if (q.kind != QuadricKind::kDisk) p = t.inverse_point(si.p);
  if (q.kind == QuadricKind::kSphere) p = glm::normalize(p);
  const LocalParameters local = local_parameters(q, p);
  SurfaceParameters s{local.uv, t.vector(local.dpdu), t.vector(local.dpdv)};
  const float sign = shape.flip_normal ? -1.0f : 1.0f, length = glm::length(t.normal(local.n));
  s.dndu = turning(sign * t.normal(local.dndu), si.ns, length);
  s.dndv = turning(sign * t.normal(local.dndv), si.ns, length);
  return s;
}

SurfaceParameters parameters(const Sphere& sphere, const Shape& shape, const SurfaceInteraction& si) {
  return parameters(Quadric{sphere.to_world}, shape, si);
}

SurfaceParameters parameters(const Disk& disk, const Shape& shape, const SurfaceInteraction& si) {
  return parameters(Quadric{disk.to_world, QuadricKind::kDisk, 0, 0, disk.inner}, shape, si);
}

}  // namespace

SurfaceParameters surface_parameters(const Shape& shape, const SurfaceInteraction& si) {
  return std::visit([&](const auto& geometry) { return parameters(geometry, shape, si); }, shape.geometry);
}

}  // namespace kaustik
