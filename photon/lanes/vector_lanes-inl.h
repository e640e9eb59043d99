// 3-vectors and sampling in SIMD lanes, for files that foreach_target.h compiles once per instruction set.
// Nothing is fused: results have the same bits as those of GLM, core/sampling/warp.h and core/math/frame.h.

#if defined(KAUSTIK_VECTOR_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef KAUSTIK_VECTOR_LANES
#undef KAUSTIK_VECTOR_LANES
#else
#define KAUSTIK_VECTOR_LANES
#endif

#include <hwy/highway.h>

#include "photon/lanes/photon_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace kaustik::photon::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kPhotonLanes>;
using Vf = hn::Vec<Floats>;
using Mask = hn::Mask<Floats>;
using Columns3 = LaneColumn[3];

// A 3-vector in each lane.
template <class V>
struct Vec3 {
  V x, y, z;
};

template <class V>
HWY_INLINE Vec3<V> operator*(V s, const Vec3<V>& v) {
  return {hn::Mul(s, v.x), hn::Mul(s, v.y), hn::Mul(s, v.z)};
}
template <class V>
HWY_INLINE Vec3<V> operator*(const Vec3<V>& a, const Vec3<V>& b) {
  return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
}
template <class V>
HWY_INLINE Vec3<V> operator+(const Vec3<V>& a, const Vec3<V>& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
template <class V>
HWY_INLINE Vec3<V> operator-(const Vec3<V>& a, const Vec3<V>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class V>
HWY_INLINE V Dot(const Vec3<V>& a, const Vec3<V>& b) {
  const Vec3<V> t = a * b;
  return hn::Add(hn::Add(t.x, t.y), t.z);
}
template <class V>
HWY_INLINE Vec3<V> Cross(const Vec3<V>& a, const Vec3<V>& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(b.y, a.z)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(b.z, a.x)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(b.x, a.y))};
}
HWY_INLINE Vf Largest(const Vec3<Vf>& v) {
  return hn::Max(v.x, hn::Max(v.y, v.z));
}
HWY_INLINE Vf LargestMagnitude(const Vec3<Vf>& v) {
  return Largest({hn::Abs(v.x), hn::Abs(v.y), hn::Abs(v.z)});
}

HWY_INLINE Vec3<Vf> Load(const Columns3& c, size_t k) {
  const Floats d;
  return {hn::Load(d, c[0] + k), hn::Load(d, c[1] + k), hn::Load(d, c[2] + k)};
}
HWY_INLINE void Store(const Vec3<Vf>& v, Columns3& c, size_t k) {
  const Floats d;
  hn::Store(v.x, d, c[0] + k);
  hn::Store(v.y, d, c[1] + k);
  hn::Store(v.z, d, c[2] + k);
}

// Evaluates c0 + x (c1 + x (c2 ...)), for the polynomials of cos_sin_octant().
template <class... Rest>
HWY_INLINE Vf Horner(Vf x, float first, Rest... rest) {
  const Vf c = hn::Set(Floats(), first);
  if constexpr (sizeof...(rest) == 0) {
    return c;
  } else {
    return hn::Add(c, hn::Mul(x, Horner(x, rest...)));
  }
}

// Same operations as sample_cosine_hemisphere().
HWY_INLINE Vec3<Vf> SampleCosineHemisphere(Vf u0, Vf u1) {
  const Floats d;
  const Vf one = hn::Set(d, 1.0f), two = hn::Set(d, 2.0f), zero = hn::Zero(d);
  const Vf a = hn::Sub(hn::Mul(two, u0), one), b = hn::Sub(hn::Mul(two, u1), one);
  const Mask along_x = hn::Gt(hn::Abs(a), hn::Abs(b));
  const Vf longer = hn::IfThenElse(along_x, a, b), shorter = hn::IfThenElse(along_x, b, a);
  const Vf ratio = hn::IfThenZeroElse(hn::Eq(longer, zero), hn::Div(shorter, longer));
  const Vf x = hn::Mul(hn::Set(d, 0.25f * kPi), ratio), x2 = hn::Mul(x, x);
  const Vf sine =
      hn::Add(x, hn::Mul(hn::Mul(x, x2), Horner(x2, -1.0f / 6, 1.0f / 120, -1.0f / 5040, 1.0f / 362880)));
  const Vf cosine = Horner(x2, 1.0f, -0.5f, 1.0f / 24, -1.0f / 720, 1.0f / 40320, -1.0f / 3628800);
  const Mask negative = hn::Lt(longer, zero);
  const Vf c = hn::IfThenElse(negative, hn::Neg(cosine), cosine);
  const Vf s = hn::IfThenElse(negative, hn::Neg(sine), sine);
  const Vf r = hn::Abs(longer);
  const Vf z = hn::Sqrt(hn::Mul(hn::Sub(one, r), hn::Add(one, r)));
  return {hn::Mul(r, hn::IfThenElse(along_x, c, s)), hn::Mul(r, hn::IfThenElse(along_x, s, c)), z};
}

// The x and y axes of Frame::from_z(z).
struct Tangents {
  Vec3<Vf> x, y;
};
HWY_INLINE Tangents TangentsOf(const Vec3<Vf>& z) {
  const Floats d;
  const Vf one = hn::Set(d, 1.0f);
  const Vf sign = hn::CopySign(one, z.z);
  const Vf a = hn::Div(hn::Neg(one), hn::Add(sign, z.z));
  const Vf b = hn::Mul(hn::Mul(z.x, z.y), a);
  return {{hn::Add(one, hn::Mul(hn::Mul(hn::Mul(sign, z.x), z.x), a)), hn::Mul(sign, b),
           hn::Mul(hn::Neg(sign), z.x)},
          {b, hn::Add(sign, hn::Mul(hn::Mul(z.y, z.y), a)), hn::Neg(z.y)}};
}

// ToWorld is Frame::from_z(z).to_world(v), ToLocal is Frame::from_z(z).to_local(v).
HWY_INLINE Vec3<Vf> ToWorld(const Vec3<Vf>& z, const Vec3<Vf>& v) {
  const Tangents t = TangentsOf(z);
  return v.x * t.x + v.y * t.y + v.z * z;
}
HWY_INLINE Vec3<Vf> ToLocal(const Vec3<Vf>& z, const Vec3<Vf>& v) {
  const Tangents t = TangentsOf(z);
  return {Dot(v, t.x), Dot(v, t.y), Dot(v, z)};
}

}  // namespace kaustik::photon::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
