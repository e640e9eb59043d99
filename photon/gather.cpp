// The sums over blocks of photons, compiled once per instruction set (Google Highway) and chosen at run time.

#include "photon/gather.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "photon/gather.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "photon/block_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace kaustik::photon::HWY_NAMESPACE {

// Power of photons i ... as components times scale. Beyond the photons they may be anything, also NaN.
// RGB9E5 is taken apart with few operations: components two and three stay 2^9 and 2^18 times too large, and
// scale is 2^-39 of what it should be (2^(e - 63) for the format's 2^(e - 24)). kUnit mends the sums.
struct Rgb9e5Power {
  static constexpr float kUnit[3] = {0x1p39f, 0x1p30f, 0x1p21f};
  Vf component[3], scale;

  HWY_INLINE Rgb9e5Power(const PhotonColumns& c, uint64_t i) {
    const Floats d;
    const Words u;
    const hn::RebindToSigned<Floats> s;
    const Vu bits = hn::LoadU(u, c.power + i);
    const Vu exponent = hn::OrAnd(hn::Set(u, 64u << 23), hn::ShiftRight<4>(bits), hn::Set(u, 31u << 23));
    scale = hn::BitCast(d, exponent);
    for (int k = 0; k < 3; ++k)
      component[k] = hn::ConvertTo(d, hn::BitCast(s, hn::And(bits, hn::Set(u, 511u << (9 * k)))));
  }
};

struct F32Power {
  static constexpr float kUnit[3] = {1, 1, 1};
  Vf component[3], scale;

  HWY_INLINE F32Power(const PhotonColumns& c, uint64_t i) : scale(hn::Set(Floats(), 1.0f)) {
    for (int k = 0; k < 3; ++k) component[k] = hn::LoadU(Floats(), c.power_f32[k] + i);
  }
};

template <KernelType kType>
HWY_INLINE Vf Weight(Vf distance_squared, Vf slope) {
  const Vf one = hn::Set(Floats(), 1.0f);
  if constexpr (kType == KernelType::kCone) return hn::NegMulAdd(slope, hn::Sqrt(distance_squared), one);
  if constexpr (kType == KernelType::kEpanechnikov) return hn::NegMulAdd(slope, distance_squared, one);
  return one;
}

// The constructor is written out: what the compiler generates is not compiled for the target.
template <class Power, KernelType kType>
struct FluxSum {
  Vf x, y, z, slope;
  uint64_t accepted = 0;

  HWY_INLINE explicit FluxSum(float s) : x(hn::Zero(Floats())), y(x), z(x), slope(hn::Set(Floats(), s)) {}

  HWY_INLINE void Add(const PhotonColumns& c, uint64_t i, Vf distance_squared, Mask counts) {
    accepted += hn::CountTrue(Floats(), counts);
    const Power power(c, i);
    const Vf weight = hn::Mul(Weight<kType>(distance_squared, slope), power.scale);
    const Vf factor = hn::IfThenElseZero(counts, weight);
    x = hn::MulAdd(power.component[0], factor, x);
    y = hn::MulAdd(power.component[1], factor, y);
    z = hn::MulAdd(power.component[2], factor, z);
  }
  HWY_INLINE void MoveTo(GatherSum& total) {
    const auto moved = [](Vf sum, float unit)
                           HWY_ATTR { return double(hn::GetLane(hn::SumOfLanes(Floats(), sum)) * unit); };
    total.flux += glm::dvec3(moved(x, Power::kUnit[0]), moved(y, Power::kUnit[1]), moved(z, Power::kUnit[2]));
    total.accepted += accepted;
    x = y = z = hn::Zero(Floats());
    accepted = 0;
  }
};

// At most 256 blocks: 1024 terms for one of four lanes, before the sum moves on to double.
template <class Power, KernelType kType>
HWY_INLINE void AddBlocks(const PhotonColumns c, const LaneQuery& q, const FoundBlocks& found, float slope,
                          GatherSum& total) {
  const Floats d;
  const uint32_t lanes = uint32_t(hn::Lanes(d));
  const Sphere sphere = q.sphere;
  FluxSum<Power, kType> sum(slope);
  // No branch for vectors without a photon inside: at the rim of the disc it would be mispredicted.
  for (size_t b = 0; b < found.same_size; ++b) {
    for (uint32_t j = 0; j < BoxTree::kBlockPhotons; j += lanes) {
      const Vf distance_squared = DistanceSquared(sphere, c, found.same[b] + j);
      sum.Add(c, found.same[b] + j, distance_squared, hn::Le(distance_squared, sphere.radius_squared));
    }
  }
  for (size_t b = 0; b < found.other_size; ++b) {
    for (uint32_t j = 0; j < BoxTree::kBlockPhotons; j += lanes) {
      const uint64_t i = uint64_t(found.other[b]) + j;
      const Vf distance_squared = DistanceSquared(sphere, c, i);
      sum.Add(c, i, distance_squared, Counts(q, c, i, distance_squared));
    }
  }
  sum.MoveTo(total);
  total.candidates += (found.same_size + found.other_size) * BoxTree::kBlockPhotons;
}

// Calls fn.operator()<Power, kType>().
template <class Fn>
HWY_INLINE GatherSum WithTypes(const PhotonColumns& c, KernelType kernel, const Fn& fn) {
  const auto with_kernel = [&]<class Power>() HWY_ATTR {
    if (kernel == KernelType::kCone) return fn.template operator()<Power, KernelType::kCone>();
    if (kernel == KernelType::kEpanechnikov)
      return fn.template operator()<Power, KernelType::kEpanechnikov>();
    return fn.template operator()<Power, KernelType::kConstant>();
  };
  return c.power ? with_kernel.template operator()<Rgb9e5Power>()
                 : with_kernel.template operator()<F32Power>();
}

GatherSum GatherPhotons(const IndexedPhotons& photons, const BoxTree::Start& start, const GatherQuery& query,
                        KernelType kernel, float slope) {
  const PhotonColumns& c = photons.columns;
  const LaneQuery q(query, photons.size);
  return WithTypes(c, kernel, [&]<class Power, KernelType kType>() HWY_ATTR {
    GatherSum total;
    VisitBlocks(*photons.tree, start, q, [&](const FoundBlocks& found) HWY_ATTR {
      AddBlocks<Power, kType>(c, q, found, slope, total);
    });
    return total;
  });
}

// A lane adds at most so many terms before the sum moves on to double.
inline constexpr uint64_t kMostTerms = 1024;

template <class Power, KernelType kType>
GatherSum GatherRangeLoop(const PhotonColumns& c, std::span<const PhotonRange> ranges, const LaneQuery& q,
                          float slope) {
  const Floats d;
  const uint64_t lanes = hn::Lanes(d);
  GatherSum total;
  FluxSum<Power, kType> sum(slope);
  uint64_t vectors = 0;
  const auto add = [&](uint64_t i, Mask valid) HWY_ATTR {
    const Vf distance_squared = DistanceSquared(q.sphere, c, i);
    const Mask inside = hn::And(valid, hn::Le(distance_squared, q.sphere.radius_squared));
    sum.Add(c, i, distance_squared, OnSurface(q, c, i, inside));
    if (HWY_UNLIKELY(++vectors % kMostTerms == 0)) sum.MoveTo(total);
  };
  const Mask all = hn::FirstN(d, lanes);
  for (const PhotonRange& range : ranges) {
    uint64_t i = range.begin;
    for (; i + lanes <= range.end; i += lanes) add(i, all);
    if (i < range.end) add(i, hn::FirstN(d, range.end - i));
  }
  sum.MoveTo(total);
  return total;
}

GatherSum GatherRanges(const PhotonColumns& c, std::span<const PhotonRange> ranges, const GatherQuery& query,
                       KernelType kernel, float slope) {
  const LaneQuery q(query, 0);
  return WithTypes(c, kernel, [&]<class Power, KernelType kType>() HWY_ATTR {
    return GatherRangeLoop<Power, kType>(c, ranges, q, slope);
  });
}

void SelectPhotons(const IndexedPhotons& photons, const BoxTree::Start& start, const GatherQuery& query,
                   GatherCounters& counters, TakePhotons take, void* to) {
  const Floats d;
  const Words u;
  const PhotonColumns& c = photons.columns;
  const LaneQuery q(query, photons.size);
  uint32_t index[2 * BoxTree::kBlockPhotons];
  float distances_squared[2 * BoxTree::kBlockPhotons];
  const auto select = [&](uint32_t block) HWY_ATTR {
    size_t count = 0;
    for (uint32_t j = 0; j < BoxTree::kBlockPhotons; j += uint32_t(hn::Lanes(d))) {
      const Vf distance_squared = DistanceSquared(q.sphere, c, block + j);
      const Mask counts = Counts(q, c, block + j, distance_squared);
      StoreLanes(d, distance_squared, counts, distances_squared + count);
      count += StoreLanes(u, Numbers(block + j), counts, index + count);
    }
    counters.accepted += count;
    counters.candidates += BoxTree::kBlockPhotons;
    take(to, index, distances_squared, count);
  };
  VisitBlocks(*photons.tree, start, q, [&](const FoundBlocks& found) HWY_ATTR {
    const uint32_t *same = found.same, *other = found.other;
    const uint32_t *const same_end = same + found.same_size, *const other_end = other + found.other_size;
    while (same < same_end || other < other_end) {
      const bool next_same = other == other_end || (same < same_end && *same < *other);
      select(next_same ? *same++ : *other++);
    }
  });
}

}  // namespace kaustik::photon::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kaustik::photon {

HWY_EXPORT(GatherPhotons);
HWY_EXPORT(GatherRanges);
HWY_EXPORT(SelectPhotons);

GatherSum gather_photons(const IndexedPhotons& photons, const GatherQuery& query, KernelType kernel,
                         float slope) {
  return HWY_DYNAMIC_DISPATCH(GatherPhotons)(photons, start_of(photons, query), query, kernel, slope);
}

GatherSum gather_ranges(const PhotonColumns& columns, std::span<const PhotonRange> ranges,
                        const GatherQuery& query, KernelType kernel, float slope) {
  return HWY_DYNAMIC_DISPATCH(GatherRanges)(columns, ranges, query, kernel, slope);
}

void select_photons(const IndexedPhotons& photons, const GatherQuery& query, GatherCounters& counters,
                    TakePhotons take, void* to) {
  HWY_DYNAMIC_DISPATCH(SelectPhotons)(photons, start_of(photons, query), query, counters, take, to);
}

}  // namespace kaustik::photon
#endif
