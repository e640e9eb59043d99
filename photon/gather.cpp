// The loops over contiguous photons, compiled once per instruction set (Google Highway) and chosen at run
// time.

#include "photon/gather.h"

#include <algorithm>
#include <cmath>

#include "photon/packing.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "photon/gather.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kaustik::photon::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Words = hn::RebindToUnsigned<Floats>;
using Vf = hn::Vec<Floats>;
using Vu = hn::Vec<Words>;
using Mask = hn::Mask<Floats>;

// The query, spread over the lanes.
struct LaneQuery {
  Vf px, py, pz, nx, ny, nz, radius_squared;
  Vu surface;

  LaneQuery(const GatherQuery& q, float r2)
      : px(hn::Set(Floats(), q.p.x)),
        py(hn::Set(Floats(), q.p.y)),
        pz(hn::Set(Floats(), q.p.z)),
        nx(hn::Set(Floats(), q.n.x)),
        ny(hn::Set(Floats(), q.n.y)),
        nz(hn::Set(Floats(), q.n.z)),
        radius_squared(hn::Set(Floats(), r2)),
        surface(hn::Set(Words(), pack_surface(q.n, q.surface_group))) {}
};

HWY_INLINE Vf DistanceSquared(const LaneQuery& q, const PhotonColumns& c, uint64_t i) {
  const Floats d;
  const Vf dx = hn::Sub(hn::LoadU(d, c.x + i), q.px);
  const Vf dy = hn::Sub(hn::LoadU(d, c.y + i), q.py);
  const Vf dz = hn::Sub(hn::LoadU(d, c.z + i), q.pz);
  // Not fused, so that the same photons count on every machine.
  return hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
}

// normal_counts() and the same group, per lane.
HWY_NOINLINE Mask SurfaceCounts(const LaneQuery& q, Vu surface) {
  const Floats d;
  const Words u;
  const hn::RebindToSigned<Floats> s;
  const auto middle = hn::Set(s, 127);
  const auto byte = hn::Set(u, 255u);
  const auto same_group = hn::Eq(hn::ShiftRight<16>(surface), hn::ShiftRight<16>(q.surface));
  const auto coordinate = [&](Vu bits) HWY_ATTR {
    return hn::ConvertTo(d, hn::Sub(hn::BitCast(s, hn::And(bits, byte)), middle));
  };
  Vf a = coordinate(surface), b = coordinate(hn::ShiftRight<8>(surface));
  const Vf c = hn::Sub(hn::Sub(hn::Set(d, 127.0f), hn::Abs(a)), hn::Abs(b));
  const Vf fold = hn::Max(hn::Neg(c), hn::Zero(d));
  a = hn::Sub(a, hn::CopySign(fold, a));
  b = hn::Sub(b, hn::CopySign(fold, b));
  const Vf dot = hn::Add(hn::Add(hn::Mul(a, q.nx), hn::Mul(b, q.ny)), hn::Mul(c, q.nz));
  const Vf length_squared = hn::Add(hn::Add(hn::Mul(a, a), hn::Mul(b, b)), hn::Mul(c, c));
  const Mask near =
      hn::And(hn::Gt(dot, hn::Zero(d)),
              hn::Gt(hn::Mul(dot, dot), hn::Mul(hn::Set(d, kNormalCosine * kNormalCosine), length_squared)));
  return hn::And(near, hn::RebindMask(d, same_group));
}

// Lanes of `inside` whose photon lies on the query's surface. The very same packed surface needs no decoding.
HWY_INLINE Mask OnSurface(const LaneQuery& q, const PhotonColumns& c, uint64_t i, Mask inside) {
  const Floats d;
  const Vu surface = hn::LoadU(Words(), c.surface + i);
  const Mask same = hn::RebindMask(d, hn::Eq(surface, q.surface));
  if (HWY_LIKELY(hn::AllFalse(d, hn::AndNot(same, inside)))) return inside;
  return hn::And(inside, hn::Or(same, SurfaceCounts(q, surface)));
}

// sum += power * weight in the lanes of `inside`. Lanes beyond the photons may hold anything, also NaN.
struct Rgb9e5Power {
  static HWY_INLINE void Add(const PhotonColumns& c, uint64_t i, Mask inside, Vf weight, Vf sum[3]) {
    const Floats d;
    const Words u;
    const hn::RebindToSigned<Floats> s;
    const Vu bits = hn::LoadU(u, c.power + i);
    const auto mantissa = hn::Set(u, 511u);
    const Vf scale =
        hn::BitCast(d, hn::ShiftLeft<23>(hn::Add(hn::ShiftRight<27>(bits), hn::Set(u, 127u - 24u))));
    const Vf factor = hn::IfThenElseZero(inside, hn::Mul(weight, scale));
    const auto component = [&](Vu v)
                               HWY_ATTR { return hn::ConvertTo(d, hn::BitCast(s, hn::And(v, mantissa))); };
    sum[0] = hn::MulAdd(component(bits), factor, sum[0]);
    sum[1] = hn::MulAdd(component(hn::ShiftRight<9>(bits)), factor, sum[1]);
    sum[2] = hn::MulAdd(component(hn::ShiftRight<18>(bits)), factor, sum[2]);
  }
};

struct F32Power {
  static HWY_INLINE void Add(const PhotonColumns& c, uint64_t i, Mask inside, Vf weight, Vf sum[3]) {
    const Floats d;
    for (int k = 0; k < 3; ++k) {
      const Vf power = hn::IfThenElseZero(inside, hn::LoadU(d, c.power_f32[k] + i));
      sum[k] = hn::MulAdd(power, hn::IfThenElseZero(inside, weight), sum[k]);
    }
  }
};

template <KernelType kType>
HWY_INLINE Vf Weight(Vf distance_squared, Vf slope) {
  const Vf one = hn::Set(Floats(), 1.0f);
  if constexpr (kType == KernelType::kCone) return hn::NegMulAdd(slope, hn::Sqrt(distance_squared), one);
  if constexpr (kType == KernelType::kEpanechnikov) return hn::NegMulAdd(slope, distance_squared, one);
  return one;
}

template <class Power, KernelType kType>
struct Accumulator {
  Vf sum[3];
  Vu accepted;  // a true lane is -1

  // Written out: what the compiler generates itself is not compiled for the target.
  HWY_INLINE Accumulator() { Clear(); }
  HWY_INLINE void Clear() {
    for (Vf& s : sum) s = hn::Zero(Floats());
    accepted = hn::Zero(Words());
  }

  HWY_INLINE void Add(const LaneQuery& q, const PhotonColumns& c, uint64_t i, Mask valid, Vf slope) {
    const Floats d;
    const Vf d2 = DistanceSquared(q, c, i);
    // No branch for vectors without a photon inside: at the rim of the disc it would be mispredicted.
    const Mask inside = OnSurface(q, c, i, hn::And(valid, hn::Le(d2, q.radius_squared)));
    accepted = hn::Sub(accepted, hn::BitCast(Words(), hn::VecFromMask(d, inside)));
    Power::Add(c, i, inside, Weight<kType>(d2, slope), sum);
  }
  HWY_INLINE void Flush(GatherSum& out) {
    const Floats d;
    for (int k = 0; k < 3; ++k) out.flux[k] += double(hn::GetLane(hn::SumOfLanes(d, sum[k])));
    out.accepted += hn::GetLane(hn::SumOfLanes(Words(), accepted));
    Clear();
  }
};

// A lane adds at most so many terms before the sum moves on to double.
inline constexpr uint64_t kFlushVectors = 1024;

template <class Power, KernelType kType>
GatherSum GatherLoop(const PhotonColumns& c, std::span<const PhotonRange> ranges, const GatherQuery& query,
                     float slope_value) {
  const Floats d;
  const uint64_t lanes = hn::Lanes(d);
  const LaneQuery q(query, query.radius * query.radius);
  const Vf slope = hn::Set(d, slope_value);
  const Mask all = hn::FirstN(d, lanes);
  GatherSum out;
  Accumulator<Power, kType> accumulator;
  uint64_t vectors = 0;
  for (const PhotonRange& range : ranges) {
    uint64_t i = range.begin;
    for (; i + lanes <= range.end; i += lanes) {
      accumulator.Add(q, c, i, all, slope);
      if (HWY_UNLIKELY(++vectors == kFlushVectors)) {
        accumulator.Flush(out);
        vectors = 0;
      }
    }
    if (i < range.end) accumulator.Add(q, c, i, hn::FirstN(d, range.end - i), slope);
  }
  accumulator.Flush(out);
  return out;
}

template <class Power>
GatherSum GatherWithPower(const PhotonColumns& c, std::span<const PhotonRange> ranges,
                          const GatherQuery& query, KernelType kernel, float slope) {
  switch (kernel) {
    case KernelType::kCone:
      return GatherLoop<Power, KernelType::kCone>(c, ranges, query, slope);
    case KernelType::kEpanechnikov:
      return GatherLoop<Power, KernelType::kEpanechnikov>(c, ranges, query, slope);
    case KernelType::kConstant:
      break;
  }
  return GatherLoop<Power, KernelType::kConstant>(c, ranges, query, slope);
}

GatherSum GatherRanges(const PhotonColumns& c, std::span<const PhotonRange> ranges, const GatherQuery& query,
                       KernelType kernel, float slope) {
  if (c.power) return GatherWithPower<Rgb9e5Power>(c, ranges, query, kernel, slope);
  return GatherWithPower<F32Power>(c, ranges, query, kernel, slope);
}

size_t SelectRange(const PhotonColumns& c, PhotonRange range, const GatherQuery& query, float radius_squared,
                   uint32_t* index, float* distance_squared) {
  const Floats d;
  const Words u;
  const uint64_t lanes = hn::Lanes(d);
  const LaneQuery q(query, radius_squared);
  size_t count = 0;
  for (uint64_t i = range.begin; i < range.end; i += lanes) {
    const Vf d2 = DistanceSquared(q, c, i);
    const Mask valid = hn::FirstN(d, size_t(std::min(lanes, range.end - i)));
    Mask inside = hn::And(valid, hn::Le(d2, q.radius_squared));
    if (hn::AllFalse(d, inside)) continue;
    inside = OnSurface(q, c, i, inside);
    const Vu ids = hn::Iota(u, uint32_t(i - range.begin));
    hn::CompressStore(ids, hn::RebindMask(u, inside), u, index + count);
    count += hn::CompressStore(d2, inside, d, distance_squared + count);
  }
  return count;
}

}  // namespace kaustik::photon::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kaustik::photon {

HWY_EXPORT(GatherRanges);
HWY_EXPORT(SelectRange);

GatherSum gather_ranges(const PhotonColumns& columns, std::span<const PhotonRange> ranges,
                        const GatherQuery& query, KernelType kernel, float slope) {
  return HWY_DYNAMIC_DISPATCH(GatherRanges)(columns, ranges, query, kernel, slope);
}

size_t select_range(const PhotonColumns& columns, PhotonRange range, const GatherQuery& query,
                    float radius_squared, uint32_t* index, float* distance_squared) {
  return HWY_DYNAMIC_DISPATCH(SelectRange)(columns, range, query, radius_squared, index, distance_squared);
}

}  // namespace kaustik::photon
#endif
