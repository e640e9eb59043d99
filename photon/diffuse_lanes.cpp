// Diffuse vertices in SIMD lanes (Google Highway). Nothing is fused and nothing approximated: the results do
// not depend on the instruction set.

#include "photon/diffuse_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "photon/diffuse_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "photon/vector_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace kaustik::photon::HWY_NAMESPACE {

using Doubles = hn::CappedTag<double, DiffuseLanes::kLanes / 2>;
using HalfFloats = hn::Rebind<float, Doubles>;
using Vd = hn::Vec<Doubles>;

// Difference of two corners, rounded to float as everywhere, then widened.
HWY_INLINE Vec3<Vd> WideEdge(const Columns3& to, const Columns3& from, size_t k) {
  const Doubles d;
  const HalfFloats f;
  const auto side = [&](int c) HWY_ATTR {
    return hn::PromoteTo(d, hn::Sub(hn::Load(f, to[c] + k), hn::Load(f, from[c] + k)));
  };
  return {side(0), side(1), side(2)};
}

// triangle_normal() of lanes k and following.
HWY_INLINE void StoreNormals(DiffuseLanes& lanes, size_t k) {
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

void LocateLanes(DiffuseLanes& lanes, size_t count) {
  const Floats d;
  for (size_t k = 0; k < count; k += hn::Lanes(Doubles())) StoreNormals(lanes, k);
  for (size_t k = 0; k < count; k += hn::Lanes(d)) {
    const Vec3<Vf> p0 = Load(lanes.corner[0], k);
    const Vec3<Vf> e1 = Load(lanes.corner[1], k) - p0, e2 = Load(lanes.corner[2], k) - p0;
    const Vf b1 = hn::Load(d, lanes.hit.u + k), b2 = hn::Load(d, lanes.hit.v + k);
    const Vec3<Vf> p = p0 + (b1 * e1 + b2 * e2);
    Store(p, lanes.p, k);
    const Vec3<Vf> n = Load(lanes.n, k);
    const Vf cos_in = Dot(Load(lanes.ray.d, k), n);
    hn::Store(cos_in, d, lanes.cos_in + k);
    const Mask along = hn::Gt(cos_in, hn::Zero(d));
    const auto turned = [&](Vf c) HWY_ATTR { return hn::IfThenElse(along, hn::Neg(c), c); };
    Store({turned(n.x), turned(n.y), turned(n.z)}, lanes.facing, k);
    const Vf extent = hn::Add(LargestMagnitude(e1), LargestMagnitude(e2));
    const Vf position_error = hn::Mul(hn::Set(d, gamma_bound(6)), LargestMagnitude(p));
    hn::Store(hn::Add(position_error, hn::Mul(hn::Set(d, gamma_bound(16)), extent)), d, lanes.p_error + k);
  }
}

// The next direction in `out`, and where there is one.
HWY_INLINE Mask SampleDirection(const DiffuseLanes& lanes, const SobolLanes& numbers, size_t k,
                                Vec3<Vf>& out) {
  const Floats d;
  const Vf zero = hn::Zero(d);
  const Vec3<Vf> n = Load(lanes.n, k);
  const Vf wo_z = hn::Neg(hn::Load(d, lanes.cos_in + k));
  Vec3<Vf> wi = SampleCosineHemisphere(hn::Load(d, numbers.u[0] + k), hn::Load(d, numbers.u[1] + k));
  wi.z = hn::IfThenElse(hn::Lt(wo_z, zero), hn::Neg(wi.z), wi.z);
  const Vec3<Vf> w = ToWorld(n, wi);
  // unit()
  const Vf step = hn::Sub(hn::Set(d, 1.5f), hn::Mul(hn::Set(d, 0.5f), Dot(w, w)));
  out = step * w;
  const Mask same_side = hn::Gt(hn::Mul(wo_z, wi.z), zero);
  return hn::And(same_side, hn::Gt(hn::Mul(Dot(out, n), wi.z), zero));
}

// The flux after the reflection and roulette in `out`.
HWY_INLINE hn::Vec<hn::RebindToSigned<Floats>> Roulette(const DiffuseLanes& lanes, Vf u, size_t k,
                                                        Vec3<Vf>& out) {
  const Floats d;
  const hn::RebindToSigned<Floats> i;
  const Vf zero = hn::Zero(d);
  const Vec3<Vf> flux = Load(lanes.flux, k);
  const Vec3<Vf> next = Load(lanes.reflectance, k) * flux;
  const Vf before = Largest(flux), after = Largest(next);
  const auto is_flux = [&](Vf x)
                           HWY_ATTR { return hn::And(hn::Ge(x, zero), hn::Lt(x, hn::Set(d, kInfinity))); };
  const Mask valid = hn::And(is_flux(next.x), hn::And(is_flux(next.y), is_flux(next.z)));
  const Mask dims = hn::Lt(after, before);
  const Mask alive = hn::And(hn::Gt(after, zero), hn::Or(hn::Not(dims), hn::Lt(hn::Mul(u, before), after)));
  out = hn::IfThenElse(dims, hn::Div(before, after), hn::Set(d, 1.0f)) * next;
  const auto as_alive = hn::IfThenElseZero(hn::RebindMask(i, alive), hn::Set(i, DiffuseLanes::kAlive));
  return hn::IfThenElse(hn::RebindMask(i, valid), as_alive, hn::Set(i, DiffuseLanes::kInvalid));
}

void ScatterLanes(DiffuseLanes& lanes, const SobolLanes& numbers, size_t count) {
  const Floats d;
  const hn::RebindToSigned<Floats> i;
  for (size_t k = 0; k < count; k += hn::Lanes(d)) {
    Vec3<Vf> w, flux;
    const Mask scattered = SampleDirection(lanes, numbers, k, w);
    const auto fate = Roulette(lanes, hn::Load(d, numbers.u[2] + k), k, flux);
    hn::Store(hn::IfThenElseZero(hn::RebindMask(i, scattered), fate), i, lanes.fate + k);
    Store(w, lanes.next.d, k);
    Store(flux, lanes.next_flux, k);
    // offset_origin()
    const Vec3<Vf> n = Load(lanes.n, k), p = Load(lanes.p, k);
    const Vf p_error = hn::Load(d, lanes.p_error + k);
    const Mask behind = hn::Lt(Dot(w, n), hn::Zero(d));
    Store(p + hn::IfThenElse(behind, hn::Neg(p_error), p_error) * n, lanes.next.o, k);
  }
}

}  // namespace kaustik::photon::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kaustik::photon {

HWY_EXPORT(LocateLanes);
HWY_EXPORT(ScatterLanes);

void locate_lanes(DiffuseLanes& lanes, size_t count) {
  HWY_DYNAMIC_DISPATCH(LocateLanes)(lanes, count);
}

void scatter_lanes(DiffuseLanes& lanes, const SobolLanes& numbers, size_t count) {
  HWY_DYNAMIC_DISPATCH(ScatterLanes)(lanes, numbers, count);
}

}  // namespace kaustik::photon
#endif
