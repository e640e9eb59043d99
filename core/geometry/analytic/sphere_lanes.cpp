// Sphere intersection in SIMD lanes (Google Highway), with the operations of intersect_sphere() in the same
// order and no fused ones, so that the bits are the same.

#include "core/geometry/analytic/sphere_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/geometry/analytic/sphere_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kaustik::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kSphereLanes>;
using Vf = hn::Vec<Floats>;
struct Vec3 {
  Vf x, y, z;
};

HWY_INLINE Vf Dot(const Vec3& a, const Vec3& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE Vec3 Multiply(const glm::mat3& m, const Vec3& v) {
  const Floats d;
  const auto row = [&](int r) HWY_ATTR {
    const Vf x = hn::Mul(hn::Set(d, m[0][r]), v.x), y = hn::Mul(hn::Set(d, m[1][r]), v.y);
    return hn::Add(hn::Add(x, y), hn::Mul(hn::Set(d, m[2][r]), v.z));
  };
  return {row(0), row(1), row(2)};
}

// Intersects rays in the sphere's own space.
HWY_INLINE Vf IntersectUnitSphere(const Vec3& o, const Vec3& d, Vf t_max) {
  const Floats f;
  const Vf zero = hn::Zero(f), one = hn::Set(f, 1.0f), none = hn::Set(f, kInfinity);
  const Vf a = Dot(d, d), b = hn::Neg(Dot(o, d)), along = hn::Div(b, a);
  const Vec3 nearest{hn::Add(o.x, hn::Mul(along, d.x)), hn::Add(o.y, hn::Mul(along, d.y)),
                     hn::Add(o.z, hn::Mul(along, d.z))};
  const Vf discriminant = hn::Sub(one, Dot(nearest, nearest));
  const auto meets = hn::Ge(discriminant, zero);
  const Vf root = hn::Sqrt(hn::Mul(a, hn::IfThenElseZero(meets, discriminant)));
  const Vf distance = hn::Sqrt(Dot(o, o));
  const Vf c = hn::Mul(hn::Sub(distance, one), hn::Add(distance, one));
  const auto outside = hn::Gt(c, zero), away = hn::Le(b, zero), forward = hn::Ge(b, zero);
  const Vf near_t = hn::Div(c, hn::Add(b, root));
  const Vf far_t = hn::IfThenElse(forward, hn::Div(hn::Add(b, root), a), hn::Div(c, hn::Sub(b, root)));
  const Vf t = hn::IfThenElse(outside, near_t, far_t);
  const auto within = hn::And(hn::Gt(t, zero), hn::Lt(t, t_max));
  const auto hit = hn::And(hn::And(meets, within), hn::Not(hn::And(outside, away)));
  return hn::IfThenElse(hit, t, none);
}

void IntersectSphereLanes(const Sphere& sphere, const SphereRays& rays, size_t count, float* t) {
  const Floats f;
  const Transform& to_world = sphere.to_world;
  const auto& c = to_world.translation;
  for (size_t k = 0; k < count; k += hn::Lanes(f)) {
    const auto from_center = [&](int i)
                                 HWY_ATTR { return hn::Sub(hn::Load(f, rays.o[i] + k), hn::Set(f, c[i])); };
    const auto component = [&](int i) HWY_ATTR { return hn::Load(f, rays.d[i] + k); };
    const Vec3 o = Multiply(to_world.inverse_linear, {from_center(0), from_center(1), from_center(2)});
    const Vec3 d = Multiply(to_world.inverse_linear, {component(0), component(1), component(2)});
    hn::Store(IntersectUnitSphere(o, d, hn::Load(f, rays.t_max + k)), f, t + k);
  }
}

}  // namespace kaustik::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kaustik {

HWY_EXPORT(IntersectSphereLanes);

void intersect_sphere_lanes(const Sphere& sphere, const SphereRays& rays, size_t count, float* t) {
  HWY_DYNAMIC_DISPATCH(IntersectSphereLanes)(sphere, rays, count, t);
}

}  // namespace kaustik
#endif
