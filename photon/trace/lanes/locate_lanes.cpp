// Surface points in SIMD lanes (Google Highway): the operations of core/geometry/interaction.cpp in the same
// order. Nothing is fused and nothing approximated, so the results do not depend on the instruction set.

#include <bit>

#include "core/geometry/analytic/quadric_bounds.h"
#include "photon/trace/lanes/vertex_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "photon/trace/lanes/locate_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "photon/lanes/vector_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace kaustik::photon::HWY_NAMESPACE {

using Doubles = hn::CappedTag<double, kPhotonLanes / 2>;
using HalfFloats = hn::Rebind<float, Doubles>;
using Vd = hn::Vec<Doubles>;
using Words = hn::RebindToUnsigned<Floats>;

// Edge between two corners, rounded to float like the scalar code and then widened to double.
HWY_INLINE Vec3<Vd> WideEdge(const Columns3& to, const Columns3& from, size_t k) {
  const Doubles d;
  const HalfFloats f;
  const auto side = [&](int c) HWY_ATTR {
    return hn::PromoteTo(d, hn::Sub(hn::Load(f, to[c] + k), hn::Load(f, from[c] + k)));
  };
  return {side(0), side(1), side(2)};
}

// Computes triangle_normal() for one vector of lanes from k.
HWY_INLINE void StoreNormals(VertexLanes& lanes, size_t k) {
  const Doubles d;
  const HalfFloats f;
  const Vec3<Vd> n =
      Cross(WideEdge(lanes.corner[1], lanes.corner[0], k), WideEdge(lanes.corner[2], lanes.corner[0], k));
  const Vd length = hn::Sqrt(Dot(n, n));
  const auto proper = hn::Gt(length, hn::Zero(d));
  const auto flip = hn::Load(f, lanes.flip + k);
  const auto store = [&](Vd component, float* column) HWY_ATTR {
    const auto unit = hn::DemoteTo(f, hn::IfThenElseZero(proper, hn::Div(component, length)));
    hn::Store(hn::Mul(unit, flip), f, column + k);
  };
  store(n.x, lanes.n[0]);
  store(n.y, lanes.n[1]);
  store(n.z, lanes.n[2]);
}

// Stores cos_in = d.n, and n flipped to the side that the photon comes from.
HWY_INLINE void StoreSides(VertexLanes& lanes, size_t k) {
  const Floats d;
  const Vec3<Vf> n = Load(lanes.n, k);
  const Vf cos_in = Dot(Load(lanes.ray.d, k), n);
  hn::Store(cos_in, d, lanes.cos_in + k);
  const Mask along = hn::Gt(cos_in, hn::Zero(d));
  const auto turned = [&](Vf c) HWY_ATTR { return hn::IfThenElse(along, hn::Neg(c), c); };
  Store({turned(n.x), turned(n.y), turned(n.z)}, lanes.facing, k);
}

void LocateOnTriangles(VertexLanes& lanes, size_t count) {
  const Floats d;
  for (size_t k = 0; k < count; k += hn::Lanes(Doubles())) StoreNormals(lanes, k);
  for (size_t k = 0; k < count; k += hn::Lanes(d)) {
    const Vec3<Vf> p0 = Load(lanes.corner[0], k);
    const Vec3<Vf> e1 = Load(lanes.corner[1], k) - p0, e2 = Load(lanes.corner[2], k) - p0;
    const Vf b1 = hn::Load(d, lanes.hit.u + k), b2 = hn::Load(d, lanes.hit.v + k);
    const Vec3<Vf> p = p0 + (b1 * e1 + b2 * e2);
    Store(p, lanes.p, k);
    StoreSides(lanes, k);
    const Vf extent = hn::Add(LargestMagnitude(e1), LargestMagnitude(e2));
    const Vf position_error = hn::Mul(hn::Set(d, gamma_bound(6)), LargestMagnitude(p));
    hn::Store(hn::Add(position_error, hn::Mul(hn::Set(d, gamma_bound(16)), extent)), d, lanes.p_error + k);
  }
}

HWY_INLINE Vec3<Vf> Multiply(const glm::mat3& m, const Vec3<Vf>& v) {
  const Floats d;
  const auto row = [&](int r) HWY_ATTR {
    const Vf x = hn::Mul(hn::Set(d, m[0][r]), v.x), y = hn::Mul(hn::Set(d, m[1][r]), v.y);
    return hn::Add(hn::Add(x, y), hn::Mul(hn::Set(d, m[2][r]), v.z));
  };
  return {row(0), row(1), row(2)};
}

// Same operations as glm::normalize().
HWY_INLINE Vec3<Vf> Normalize(const Vec3<Vf>& v) {
  return hn::Div(hn::Set(Floats(), 1.0f), hn::Sqrt(Dot(v, v))) * v;
}

// Computes unit_vector() in the lanes of `here`; the others, which may hold anything, are not worth more
// work.
HWY_INLINE Vec3<Vf> UnitVector(Mask here, const Vec3<Vf>& v) {
  const Floats d;
  const Vf zero = hn::Zero(d), one = hn::Set(d, 1.0f), square = Dot(v, v), largest = LargestMagnitude(v);
  const Mask ordinary =
      hn::And(hn::Gt(square, hn::Set(d, kLeastSquare)), hn::Lt(square, hn::Set(d, kLargestSquare)));
  const Vec3<Vf> unit = Normalize(v);
  if (hn::AllTrue(d, hn::Or(ordinary, hn::Not(here)))) return unit;
  const Mask finite = hn::And(hn::And(hn::IsFinite(v.x), hn::IsFinite(v.y)), hn::IsFinite(v.z));
  const Mask proper = hn::And(finite, hn::Gt(largest, zero));
  const Vf power = hn::And(largest, hn::BitCast(d, hn::Set(Words(), kExponentBits)));
  const Vf scale = hn::Max(power, hn::Set(d, std::numeric_limits<float>::min()));
  const Vec3<Vf> scaled = Normalize({hn::Div(v.x, scale), hn::Div(v.y, scale), hn::Div(v.z, scale)});
  const auto select = [&](Vf its, Vf of_scaled, Vf of_axis) HWY_ATTR {
    return hn::IfThenElse(ordinary, its, hn::IfThenElse(proper, of_scaled, of_axis));
  };
  return {select(unit.x, scaled.x, one), select(unit.y, scaled.y, zero), select(unit.z, scaled.z, zero)};
}

HWY_INLINE void StoreWhere(Mask mask, const Vec3<Vf>& v, Columns3& c, size_t k) {
  const Vec3<Vf> old = Load(c, k);
  Store(
      {hn::IfThenElse(mask, v.x, old.x), hn::IfThenElse(mask, v.y, old.y), hn::IfThenElse(mask, v.z, old.z)},
      c, k);
}

// Computes the lanes whose hit is on this shape; leaves the others unchanged.
void LocateOnSphere(VertexLanes& lanes, uint32_t shape, const Transform& to_world, float p_error,
                    size_t count) {
  const Floats d;
  const Words w;
  const auto& c = to_world.translation;
  const Vec3<Vf> center{hn::Set(d, c.x), hn::Set(d, c.y), hn::Set(d, c.z)};
  for (size_t k = 0; k < count; k += hn::Lanes(d)) {
    const auto same = hn::Eq(hn::Load(w, lanes.hit.shape + k), hn::Set(w, shape));
    if (hn::AllFalse(w, same)) continue;
    const Mask here = hn::RebindMask(d, same);
    const Vec3<Vf> o = Multiply(to_world.inverse_linear, Load(lanes.ray.o, k) - center);
    const Vec3<Vf> to = Multiply(to_world.inverse_linear, Load(lanes.ray.d, k));
    const Vec3<Vf> on_sphere = UnitVector(here, o + hn::Load(d, lanes.hit.t + k) * to);
    const Vec3<Vf> n = UnitVector(here, Multiply(glm::transpose(to_world.inverse_linear), on_sphere));
    StoreWhere(here, hn::Load(d, lanes.flip + k) * n, lanes.n, k);
    StoreWhere(here, Multiply(to_world.linear, on_sphere) + center, lanes.p, k);
    hn::Store(hn::IfThenElse(here, hn::Set(d, p_error), hn::Load(d, lanes.p_error + k)), d,
              lanes.p_error + k);
    StoreSides(lanes, k);
  }
}

}  // namespace kaustik::photon::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kaustik::photon {

HWY_EXPORT(LocateOnTriangles);
HWY_EXPORT(LocateOnSphere);

void locate_lanes(VertexLanes& lanes, const std::vector<Shape>& shapes, size_t count) {
  HWY_DYNAMIC_DISPATCH(LocateOnTriangles)(lanes, count);
  uint64_t left = 0;  // lanes with hits on spheres that are not computed yet
  for (size_t k = 0; k < count; ++k) left |= uint64_t{(lanes.traits[k] & kSphereTrait) != 0} << k;
  while (left != 0) {
    const uint32_t shape = lanes.hit.shape[std::countr_zero(left)];
    const Transform& to_world = std::get<Sphere>(shapes[shape].geometry).to_world;
    HWY_DYNAMIC_DISPATCH(LocateOnSphere)(lanes, shape, to_world, sphere_error(to_world), count);
    for (uint64_t rest = left; rest != 0; rest &= rest - 1) {
      const int k = std::countr_zero(rest);
      left &= ~(uint64_t{lanes.hit.shape[k] == shape} << k);
    }
  }
}

}  // namespace kaustik::photon
#endif
