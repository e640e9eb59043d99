// Sums of photon flux in SIMD lanes, compiled once per instruction set by foreach_target.h.

#if defined(KAUSTIK_FLUX_SUM) == defined(HWY_TARGET_TOGGLE)
#ifdef KAUSTIK_FLUX_SUM
#undef KAUSTIK_FLUX_SUM
#else
#define KAUSTIK_FLUX_SUM
#endif

#include <bit>

#include "photon/gather/block_lanes-inl.h"
#include "photon/gather/gather.h"

HWY_BEFORE_NAMESPACE();
namespace kaustik::photon::HWY_NAMESPACE {

using detail::GatherSum;

// Power of the photons from i on, as components times scale; beyond the last photon any value, including NaN.
// To save operations, the decoding of RGB9E5 leaves components two and three too large by 2^9 and 2^18, and
// the scale too small by 2^-39 (2^(e - 63) instead of the format's 2^(e - 24)). Multiplying the sums by kUnit
// corrects this.
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

// The polynomial w of kernel_value(), never negative.
template <KernelType kType>
HWY_INLINE Vf Weight(Vf distance_squared, Vf slope) {
  constexpr KernelRow kRow = kKernels[size_t(kType)];
  const Floats d;
  Vf s = distance_squared;
  if constexpr (!kRow.even()) s = hn::Sqrt(s);
  Vf w = hn::Set(d, kRow.a[size_t(kRow.degree())]);
  for (int j = kRow.degree() - kRow.step(); j >= 0; j -= kRow.step())
    w = hn::MulAdd(hn::Mul(w, slope), s, hn::Set(d, kRow.a[size_t(j)]));
  if constexpr (kRow.degree() > 0) w = hn::Max(w, hn::Zero(d));
  return w;
}

// Sums of flux, added up in runs of 1024 vectors of photon indices, then in runs of 1024 such runs, then in
// double. So float is precise enough for many terms, and which terms are added together depends on the
// photons' indices only, not on which blocks are read: blocks without a photon in reach add zeros and change
// no bit. The constructor is written out because a compiler-generated one is not compiled for the target.
template <KernelType kType>
struct FluxSum {
  static constexpr int kRunBits = 10, kShift = kRunBits + std::bit_width(hn::MaxLanes(Floats())) - 1;

  Vf x, y, z;                 // sums of the current run
  Vf runs_x, runs_y, runs_z;  // sums of the runs before
  glm::dvec3 total;
  uint64_t run = 0, accepted = 0;

  HWY_INLINE FluxSum() : x(hn::Zero(Floats())), y(x), z(x), runs_x(x), runs_y(x), runs_z(x), total(0) {}

  HWY_INLINE Vf Stretched(Vf distance_squared, uint64_t) const { return distance_squared; }

  // Must be called before photons from i on are added; i must ascend.
  HWY_INLINE void Reach(uint64_t i) {
    if (HWY_UNLIKELY(i >> kShift != run)) Fold(i >> kShift);
  }
  HWY_INLINE void Add(const Rgb9e5Power& power, Vf weight, Mask counts) {
    accepted += hn::CountTrue(Floats(), counts);
    const Vf factor = hn::IfThenElseZero(counts, weight);
    x = hn::MulAdd(power.component[0], factor, x);
    y = hn::MulAdd(power.component[1], factor, y);
    z = hn::MulAdd(power.component[2], factor, z);
  }
  HWY_INLINE void Add(const PhotonColumns& c, uint64_t i, Vf distance_squared, Mask counts, Vf slope) {
    const Rgb9e5Power power(c, i);
    Add(power, hn::Mul(Weight<kType>(distance_squared, slope), power.scale), counts);
  }
  HWY_INLINE void AddTo(GatherSum& sum) {
    Fold(run);
    MoveRuns();
    sum.flux += total;
    sum.accepted += accepted;
  }

 private:
  HWY_INLINE void Fold(uint64_t next) {
    runs_x = hn::Add(runs_x, x);
    runs_y = hn::Add(runs_y, y);
    runs_z = hn::Add(runs_z, z);
    x = y = z = hn::Zero(Floats());
    if (HWY_UNLIKELY(next >> kRunBits != run >> kRunBits)) MoveRuns();
    run = next;
  }
  HWY_INLINE void MoveRuns() {
    const auto moved = [](Vf sum, float unit)
                           HWY_ATTR { return double(hn::GetLane(hn::SumOfLanes(Floats(), sum)) * unit); };
    total += glm::dvec3(moved(runs_x, Rgb9e5Power::kUnit[0]), moved(runs_y, Rgb9e5Power::kUnit[1]),
                        moved(runs_z, Rgb9e5Power::kUnit[2]));
    runs_x = runs_y = runs_z = hn::Zero(Floats());
  }
};

// The same sums over photons that have their own discs. A kernel on a smaller disc is higher by the stretch.
template <KernelType kType>
struct DiscFluxSum : FluxSum<kType> {
  OwnRadii reach;
  Vf sum, least;  // of the stretches of the photons that counted

  HWY_INLINE explicit DiscFluxSum(OwnRadii radii)
      : reach(radii), sum(hn::Zero(Floats())), least(hn::Inf(Floats())) {}

  HWY_INLINE Vf Stretched(Vf distance_squared, uint64_t i) const {
    return reach.OfPhotons(distance_squared, i);
  }
  HWY_INLINE void Add(const PhotonColumns& c, uint64_t i, Vf stretched, Mask counts, Vf slope) {
    const Rgb9e5Power power(c, i);
    const Vf stretch = hn::LoadU(Floats(), reach.stretch + i);
    FluxSum<kType>::Add(power, hn::Mul(hn::Mul(Weight<kType>(stretched, slope), stretch), power.scale),
                        counts);
    sum = hn::Add(sum, hn::IfThenElseZero(counts, stretch));
    least = hn::Min(least, hn::IfThenElse(counts, stretch, hn::Inf(Floats())));
  }
  HWY_INLINE void AddTo(GatherSum& to) {
    FluxSum<kType>::AddTo(to);
    to.stretch += double(hn::GetLane(hn::SumOfLanes(Floats(), sum)));
    to.least_stretch = std::min(to.least_stretch, hn::GetLane(hn::MinOfLanes(Floats(), least)));
  }
};

// Adds blocks in which the surface of each photon must be checked.
template <class Sum>
HWY_INLINE void AddOthers(const PhotonColumns& c, const LaneQuery& q, const uint32_t* blocks, size_t size,
                          Vf slope, Sum& sum) {
  for (size_t b = 0; b < size; ++b) {
    sum.Reach(blocks[b]);
    for (uint32_t j = 0; j < BoxTree::kBlockPhotons; j += uint32_t(hn::Lanes(Floats()))) {
      const uint64_t i = uint64_t(blocks[b]) + j;
      const Vf distance_squared = sum.Stretched(DistanceSquared(q.sphere, c, i), i);
      sum.Add(c, i, distance_squared, Counts(q, c, i, distance_squared), slope);
    }
  }
}

}  // namespace kaustik::photon::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
