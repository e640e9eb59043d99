// Rebuilds surface points from hits, for each kind of shape.

#include "core/geometry/interaction.h"

#include "core/geometry/surface_bounds.h"

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
  si.n = glm::normalize(t.normal(triangle_normal(e1, e2)));
  if (!mesh.N.empty()) {
    const Normal3 ns = (1 - b1 - b2) * mesh.N[i0] + b1 * mesh.N[i1] + b2 * mesh.N[i2];
    if (shade(t.normal(ns), si)) return;
  }
  if (shape.flip_normal) si.n = -si.n;
  si.ns = si.n;
}

void fill(const Quadric& q, const Shape& shape, const Ray& ray, const Hit& hit, SurfaceInteraction& si) {
  const Transform& t = q.to_world;
  Point3 p(hit.uv.x, hit.uv.y, 0);
  if (q.kind != QuadricKind::kDisk) p = t.inverse_point(ray.o) + hit.t * t.inverse_vector(ray.d);
  const Normal3 local(normal_at(q, glm::dvec3(p)));
  // Project back onto the surface, so that the length of the ray affects the position along it only.
  if (q.kind == QuadricKind::kSphere) p = local;
  if (q.kind == QuadricKind::kCylinder) p = {local.x, local.y, p.z};
  const Normal3 n = glm::normalize(t.normal(local));
  si.p = t.point(p);
  si.p_error = quadric_error(q);
  si.n = si.ns = shape.flip_normal ? -n : n;
}

void fill(const Sphere& sphere, const Shape& shape, const Ray& ray, const Hit& hit, SurfaceInteraction& si) {
  const Transform& t = sphere.to_world;
  const Vector3 on_sphere = glm::normalize(t.inverse_point(ray.o) + hit.t * t.inverse_vector(ray.d));
  const Normal3 n = glm::normalize(t.normal(on_sphere));
  si.p = t.point(on_sphere);
  si.p_error = sphere_error(t);
  si.n = si.ns = shape.flip_normal ? -n : n;
}

void fill(const Disk& disk, const Shape& shape, const Ray& /*ray*/, const Hit& hit, SurfaceInteraction& si) {
  const Transform& t = disk.to_world;
  const Normal3 n = disk_normal(t);
  si.p = t.point({hit.uv.x, hit.uv.y, 0});
  si.p_error = disk_error(t);
  si.n = si.ns = shape.flip_normal ? -n : n;
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
