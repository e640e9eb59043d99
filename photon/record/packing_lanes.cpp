// The formats of photon/record/packing.cpp in SIMD lanes (Google Highway): the same operations in the same
// order, so the same bits.

#include "photon/record/packing_lanes.h"

#include "photon/record/packing.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "photon/record/packing_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kaustik::photon::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, 16>;
using Words = hn::RebindToUnsigned<Floats>;
using Ints = hn::RebindToSigned<Floats>;
using Vf = hn::Vec<Floats>;
using Vu = hn::Vec<Words>;
using Vi = hn::Vec<Ints>;

// Truncates to integers; x must be in the range of int.
HWY_INLINE Vu Truncate(Vf x) {
  return hn::BitCast(Words(), hn::ConvertTo(Ints(), x));
}

template <int kBits>
HWY_INLINE Vu PackOctahedral(Vf wx, Vf wy, Vf wz) {
  const Floats d;
  const Vf sum = hn::Add(hn::Add(hn::Abs(wx), hn::Abs(wy)), hn::Abs(wz));
  const Vf one = hn::Set(d, 1.0f), zero = hn::Zero(d);
  const auto some = hn::Gt(sum, zero);
  const Vf scale = hn::IfThenElseZero(some, hn::Div(one, sum));
  const Vf x = hn::Mul(wx, scale), y = hn::Mul(wy, scale);
  const auto below = hn::And(some, hn::Lt(wz, zero));
  const Vf folded_x = hn::CopySign(hn::Sub(one, hn::Abs(y)), x);
  const Vf folded_y = hn::CopySign(hn::Sub(one, hn::Abs(x)), y);
  constexpr float kMiddle = float((1 << (kBits - 1)) - 1);
  const auto quantise = [&](Vf t) HWY_ATTR {
    const Vf value = hn::Add(hn::Mul(t, hn::Set(d, kMiddle)), hn::Set(d, kMiddle + 0.5f));
    return Truncate(hn::Min(hn::Max(value, zero), hn::Set(d, 2 * kMiddle)));
  };
  const Vu a = quantise(hn::IfThenElse(below, folded_x, x)), b = quantise(hn::IfThenElse(below, folded_y, y));
  return hn::Or(a, hn::ShiftLeft<kBits>(b));
}

// Returns 2^e as a float.
HWY_INLINE Vf PowerOfTwo(Vi e) {
  return hn::BitCast(Floats(), hn::ShiftLeft<23>(hn::Add(e, hn::Set(Ints(), 127))));
}

HWY_INLINE Vu PackRgb9e5(const float* const (&flux)[3], size_t k, float per_unit) {
  const Floats d;
  const Ints i;
  const Vf zero = hn::Zero(d), half = hn::Set(d, 0.5f);
  const auto channel = [&](int c) HWY_ATTR {
    const Vf v = hn::Mul(hn::Load(d, flux[c] + k), hn::Set(d, per_unit));
    return hn::IfThenElseZero(hn::Gt(v, zero), hn::Min(v, hn::Set(d, kRgb9e5Max)));
  };
  const Vf r = channel(0), g = channel(1), b = channel(2);
  const Vf largest = hn::Max(r, hn::Max(g, b));
  Vi exponent = hn::ShiftRight<23>(hn::BitCast(i, largest));
  exponent = hn::Min(hn::Max(hn::Sub(exponent, hn::Set(i, 127 - 16)), hn::Zero(i)), hn::Set(i, 31));
  const auto mantissa_scale = [&](Vi e) HWY_ATTR { return PowerOfTwo(hn::Sub(hn::Set(i, 24), e)); };
  const Vf trial = hn::Add(hn::Mul(largest, mantissa_scale(exponent)), half);
  // If the largest mantissa would round to 512, the exponent is one larger.
  const auto over = hn::RebindMask(i, hn::Ge(trial, hn::Set(d, 512.0f)));
  exponent = hn::Add(exponent, hn::IfThenElseZero(over, hn::Set(i, 1)));
  const Vf scale = mantissa_scale(exponent);
  const auto round = [&](Vf v) HWY_ATTR { return Truncate(hn::Add(hn::Mul(v, scale), half)); };
  const Vu bits =
      hn::Or(hn::Or(round(r), hn::ShiftLeft<9>(round(g))),
             hn::Or(hn::ShiftLeft<18>(round(b)), hn::ShiftLeft<27>(hn::BitCast(Words(), exponent))));
  return hn::IfThenElseZero(hn::RebindMask(Words(), hn::Gt(largest, zero)), bits);
}

void PackLanes(const PhotonLanes& from, size_t count, float per_unit, PackedLanes& to) {
  const Words u;
  const Floats d;
  for (size_t k = 0; k < count; k += hn::Lanes(u)) {
    const auto towards = [&](int c) HWY_ATTR { return hn::Neg(hn::Load(d, from.d[c] + k)); };
    const auto n = [&](int c) HWY_ATTR { return hn::Load(d, from.n[c] + k); };
    hn::Store(PackOctahedral<16>(towards(0), towards(1), towards(2)), u, to.direction + k);
    hn::Store(PackRgb9e5(from.flux, k, per_unit), u, to.power + k);
    const Vu group = hn::ShiftLeft<16>(hn::Load(u, from.surface_group + k));
    hn::Store(hn::Or(PackOctahedral<8>(n(0), n(1), n(2)), group), u, to.surface + k);
  }
}

}  // namespace kaustik::photon::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kaustik::photon {

HWY_EXPORT(PackLanes);

void pack_lanes(const PhotonLanes& photons, size_t count, float flux_unit, PackedLanes* packed) {
  HWY_DYNAMIC_DISPATCH(PackLanes)(photons, count, 1 / flux_unit, *packed);
}

void RecordPacker::flush(PhotonRecords& records) {
  if (waiting_ == 0) return;
  PackedLanes packed;
  pack_lanes({{d_[0], d_[1], d_[2]}, {flux_[0], flux_[1], flux_[2]}, {n_[0], n_[1], n_[2]}, surface_group_},
             waiting_, flux_unit_, &packed);
  for (size_t k = 0; k < waiting_; ++k) {
    records.push_back(
        {p_[0][k], p_[1][k], p_[2][k], packed.direction[k], packed.power[k], packed.surface[k]});
  }
  waiting_ = 0;
}

}  // namespace kaustik::photon
#endif
