// Texture coordinates and their derivatives on triangles and quadrics, as in pbrt-v4.

#include "core/geometry/surface_parameters.h"

namespace kaustik {

namespace {

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
  if (!mesh.colours.empty())
    s.colour = (1 - b1 - b2) * mesh.colours[i0] + b1 * mesh.colours[i1] + b2 * mesh.colours[i2];
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

template <AnalyticShape G>
SurfaceParameters parameters(const G& analytic, const Shape& shape, const SurfaceInteraction& si) {
  const auto& swept = analytic.swept();
  const Transform& t = swept.to_world;
  const LocalParameters local = swept.parameters(local_point(swept, si.p, si.hit_uv));
  SurfaceParameters s{local.uv, t.vector(local.dpdu), t.vector(local.dpdv)};
  const float sign = shape.flip_normal ? -1.0f : 1.0f, length = glm::length(t.normal(local.n));
  s.dndu = turning(sign * t.normal(local.dndu), si.ns, length);
  s.dndv = turning(sign * t.normal(local.dndv), si.ns, length);
  return s;
}

}  // namespace

SurfaceParameters surface_parameters(const Shape& shape, const SurfaceInteraction& si) {
  return std::visit([&](const auto& geometry) { return parameters(geometry, shape, si); }, shape.geometry);
}

}  // namespace kaustik
