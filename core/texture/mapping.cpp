// The four texture mappings and their derivatives.

#include "core/texture/mapping.h"

namespace kaustik {

namespace {

constexpr float kInv2Pi = 0.5f * kInvPi;

// The point and its footprint in texture space.
struct TextureSpace {
  Point3 p;
  Vector3 dpdx, dpdy;

  TextureCoordinates coordinates(const Point2& st, const Vector3& dsdp, const Vector3& dtdp) const {
    return {st, {glm::dot(dsdp, dpdx), glm::dot(dtdp, dpdx)}, {glm::dot(dsdp, dpdy), glm::dot(dtdp, dpdy)}};
  }
};

TextureSpace to_texture_space(const Transform& to_world, const TexturePoint& x) {
  return {to_world.inverse_point(x.p), to_world.inverse_vector(x.dpdx), to_world.inverse_vector(x.dpdy)};
}

TextureCoordinates map(const UvMapping& m, const Transform& /*to_world*/, const TexturePoint& x) {
  const auto turned = [&m](const Vector2& v) { return m.scale * v + m.shear * Vector2(v.y, v.x); };
  return {turned(x.uv) + m.delta, turned(x.duvdx), turned(x.duvdy)};
}

TextureCoordinates map(const SphereMapping&, const Transform& to_world, const TexturePoint& x) {
  const TextureSpace space = to_texture_space(to_world, x);
  const Point3& p = space.p;
  const float xy2 = p.x * p.x + p.y * p.y, xy = std::sqrt(xy2);
  float phi = std::atan2(p.y, p.x);
  if (phi < 0) phi += 2 * kPi;
  const Point2 st(std::atan2(xy, p.z) * kInvPi, phi * kInv2Pi);
  if (!(xy > 0)) return {st};
  const Vector3 dsdp = kInvPi / (xy2 + p.z * p.z) * Vector3(p.x * p.z / xy, p.y * p.z / xy, -xy);
  return space.coordinates(st, dsdp, kInv2Pi / xy2 * Vector3(-p.y, p.x, 0));
}

TextureCoordinates map(const CylinderMapping&, const Transform& to_world, const TexturePoint& x) {
  const TextureSpace space = to_texture_space(to_world, x);
  const Point3& p = space.p;
  const float xy2 = p.x * p.x + p.y * p.y;
  const Point2 st((kPi + std::atan2(p.y, p.x)) * kInv2Pi, p.z);
  if (!(xy2 > 0)) return {st};
  return space.coordinates(st, kInv2Pi / xy2 * Vector3(-p.y, p.x, 0), {0, 0, 1});
}

TextureCoordinates map(const PlanarMapping& m, const Transform& to_world, const TexturePoint& x) {
  const TextureSpace space = to_texture_space(to_world, x);
  const Point2 st = m.delta + Vector2(glm::dot(space.p, m.vs), glm::dot(space.p, m.vt));
  return space.coordinates(st, m.vs, m.vt);
}

}  // namespace

TextureCoordinates map_to_texture(const TextureMapping& mapping, const Transform& to_world,
                                  const TexturePoint& x) {
  return std::visit([&](const auto& m) { return map(m, to_world, x); }, mapping);
}

}  // namespace kaustik
