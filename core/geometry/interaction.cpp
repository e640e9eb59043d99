// Rebuilds surface points from hits, for each kind of shape.

#include "core/geometry/interaction.h"

#include "core/geometry/triangle_bounds.h"

namespace kaustik {
namespace {

// Sets the shading normal from the vertices', if that is not zero, and turns the geometric normal to its
// side.
bool shade(const Normal3& ns, SurfaceInteraction& si) {
  const float length2 = length_squared(ns);
  if (!(length2 > 0 && std::isfinite(length2))) return false;
  si.ns = ns / std::sqrt(length2);
  if (glm::dot(si.n, si.ns) < 0) si.n = -si.n;
  return true;
}

void fill(const TriangleMesh& mesh, const Shape& shape, const Ray& /*ray*/, const Hit& hit,
          SurfaceInteraction& si) {
  const auto [i0, i1, i2] = mesh.indices[hit.primitive];
  const Point3 p0 = mesh.P[i0];
  const Vector3 e1 = mesh.P[i1] - p0;
  const Vector3 e2 = mesh.P[i2] - p0;
  const float b1 = hit.uv.x;
  const float b2 = hit.uv.y;
  si.p = p0 + (b1 * e1 + b2 * e2);
  si.p_error = triangle_error(si.p, e1, e2);
  si.n = triangle_normal(e1, e2);
  if (!mesh.N.empty()) {
    const Normal3 ns = (1 - b1 - b2) * mesh.N[i0] + b1 * mesh.N[i1] + b2 * mesh.N[i2];
    if (shade(ns, si)) return;
  }
  if (shape.flip_normal) si.n = -si.n;
  si.ns = si.n;
}

void fill(const InstancedMesh& instance, const Shape& shape, const Ray& /*ray*/, const Hit& hit,
          SurfaceInteraction& si) {
  const TriangleMesh& mesh = *instance.mesh;
  const Transform& t = instance.to_world;
  const auto [i0, i1, i2] = mesh.indices[hit.primitive];
  const Point3 p0 = mesh.P[i0];
  const Vector3 e1 = mesh.P[i1] - p0, e2 = mesh.P[i2] - p0;
  const float b1 = hit.uv.x, b2 = hit.uv.y;
  const Point3 p = p0 + (b1 * e1 + b2 * e2);
  si.p = t.point(p);
  si.p_error = instance_error(t, p, e1, e2);
  si.n = unit_vector(t.normal(triangle_normal(e1, e2)));
  if (!mesh.N.empty()) {
    const Normal3 ns = (1 - b1 - b2) * mesh.N[i0] + b1 * mesh.N[i1] + b2 * mesh.N[i2];
    if (shade(t.normal(ns), si)) return;
  }
  if (shape.flip_normal) si.n = -si.n;
  si.ns = si.n;
}

template <AnalyticShape G>
void fill(const G& analytic, const Shape& shape, const Ray& ray, const Hit& hit, SurfaceInteraction& si) {
  const SurfacePoint at = analytic.at_hit(ray, hit.t, hit.uv);
  si.p = at.p;
  si.p_error = at.p_error;
  si.n = si.ns = shape.flip_normal ? -at.n : at.n;
}

}  // namespace

SurfaceInteraction make_interaction(const std::vector<Shape>& shapes, const Ray& ray, const Hit& hit) {
  const Shape& shape = shapes[hit.shape];
  SurfaceInteraction si;
  si.shape = hit.shape;
  si.primitive = hit.primitive;
  si.hit_uv = hit.uv;
  si.material = shape.material;
  si.light = shape.light;
  si.surface_group = shape.surface_group;
  std::visit([&](const auto& geometry) { fill(geometry, shape, ray, hit, si); }, shape.geometry);
  return si;
}

}  // namespace kaustik
