// Where area lights are and where they shine.

#include "core/geometry/analytic/quadric_bounds.h"
#include "core/light/area/area.h"

namespace kaustik {
namespace {

void add_surface(const TriangleEmitter& e, LightBounds& b) {
  Vector3 sum(0);
  for (const TriangleEmitter::Triangle& t : e.triangles) {
    for (const Point3& p : {t.p0, t.p0 + t.e1, t.p0 + t.e2}) b.box.add(p);
    sum += t.n;
  }
  const float length = glm::length(sum);
  if (!(length > 0)) return;
  b.w = sum / length;
  b.cos_o = 1;
  for (const TriangleEmitter::Triangle& t : e.triangles) b.cos_o = std::min(b.cos_o, glm::dot(b.w, t.n));
}
void add_surface(const SphereEmitter& e, LightBounds& b) {
  b.box.add(e.center - e.radius);
  b.box.add(e.center + e.radius);
}
void add_surface(const DiskEmitter& e, LightBounds& b) {
  const Vector3 half = glm::abs(e.to_world.linear[0]) + glm::abs(e.to_world.linear[1]);
  b.box.add(e.to_world.translation - half);
  b.box.add(e.to_world.translation + half);
  b.w = e.n;
  b.cos_o = 1;
}

void add_surface(const SweptEmitter& e, LightBounds& b) {
  std::visit(
      [&](const auto& shape) {
        b.box.add(shape.bounds());
        if (!shape.flat()) return;
        const Normal3 n = disk_normal(shape.to_world);
        b.w = e.inward ? -n : n;
        b.cos_o = 1;
      },
      e.shape);
}

}  // namespace

std::optional<LightBounds> DiffuseAreaLight::bounds() const {
  LightBounds b;
  std::visit([&](const auto& e) { add_surface(e, b); }, surface);
  b.two_sided = twosided;
  b.phi = luminance(power()) / ((twosided ? 2 : 1) * kPi);
  // From afar, a convex surface whose normals cover all directions shows a quarter of its area (Cauchy 1832).
  if (b.cos_o < 0) b.phi *= 0.25f;
  return b;
}

double DiffuseAreaLight::brightness(double /*scene_size*/) const {
  return double(max_component(image ? L * image->brightest() : L));
}

}  // namespace kaustik
