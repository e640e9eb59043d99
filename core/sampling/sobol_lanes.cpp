// Sobol sets in SIMD lanes (Google Highway). No tables are used, because a lookup per lane costs more than
// the arithmetic for all lanes.

#include "core/sampling/sobol_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/sampling/sobol_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kaustik::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::CappedTag<uint32_t, kSobolLanes>;
using Vu = hn::Vec<Words>;

#if HWY_TARGET == HWY_SCALAR
HWY_INLINE Vu ReverseBits(Vu x) {
  return hn::Set(Words(), reverse_bits(hn::GetLane(x)));
}
#else
// Applies reverse_bits() to each lane: reverses each nibble by table lookup, then the order of the bytes.
HWY_INLINE Vu ReverseBits(Vu x) {
  const hn::Repartition<uint8_t, Words> b;
  alignas(16) static constexpr uint8_t kReversed[16] = {0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15};
  alignas(16) static constexpr uint8_t kOrder[16] = {3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12};
  const auto table = hn::LoadDup128(b, kReversed);
  const auto low = hn::Set(Words(), 0x0f0f0f0fu);
  const auto upper = hn::TableLookupBytes(table, hn::BitCast(b, hn::And(x, low)));
  const auto lower = hn::TableLookupBytes(table, hn::BitCast(b, hn::And(hn::ShiftRight<4>(x), low)));
  const Vu reversed = hn::Or(hn::ShiftLeft<4>(hn::BitCast(Words(), upper)), hn::BitCast(Words(), lower));
  return hn::BitCast(Words(), hn::TableLookupBytes(hn::BitCast(b, reversed), hn::LoadDup128(b, kOrder)));
}
#endif

// Applies laine_karras() to each lane.
HWY_INLINE Vu LaineKarras(Vu x, Vu seed) {
  const Words d;
  x = hn::Xor(x, hn::Mul(x, hn::Set(d, 0x3d20adeau)));
  x = hn::Add(x, seed);
  x = hn::Mul(x, hn::Or(hn::ShiftRight<16>(seed), hn::Set(d, 1u)));
  x = hn::Xor(x, hn::Mul(x, hn::Set(d, 0x05526c56u)));
  return hn::Xor(x, hn::Mul(x, hn::Set(d, 0x53a22864u)));
}

template <int kShift>
HWY_INLINE Vu AddSupersets(Vu x, uint32_t positions) {
  return hn::Xor(x, hn::And(hn::ShiftRight<kShift>(x), hn::Set(Words(), positions)));
}

// Dimension 1. Its generator matrix is Pascal's triangle modulo 2, so bit j of the reversed value is the sum
// of those bits i of the index for which the binary digits of i contain those of j (Lucas's theorem).
HWY_INLINE Vu SobolPascal(Vu x) {
  x = AddSupersets<1>(x, 0x55555555u);
  x = AddSupersets<2>(x, 0x33333333u);
  x = AddSupersets<4>(x, 0x0f0f0f0fu);
  x = AddSupersets<8>(x, 0x00ff00ffu);
  return AddSupersets<16>(x, 0x0000ffffu);
}

// Generator matrices of dimensions 2 and 3, taken from the tables: column i is added where bit i of the index
// is set.
struct Columns {
  uint32_t of[2][32];
};
constexpr Columns MakeColumns() {
  Columns columns{};
  for (int d = 0; d < 2; ++d) {
    for (int bit = 0; bit < 32; ++bit) {
      columns.of[d][bit] =
          kSobolTables[static_cast<size_t>(d + 1)][static_cast<size_t>(bit >> 3)][1u << (bit & 7)];
    }
  }
  return columns;
}
inline constexpr Columns kColumns = MakeColumns();

template <int kDimensions>
HWY_INLINE void SobolByColumns(Vu index, Vu (&sums)[2]) {
  const Words d;
  const hn::RebindToSigned<Words> s;
  sums[0] = sums[1] = hn::Zero(d);
  for (int bit = 31; bit >= 0; --bit) {
    const Vu is_set = hn::BitCast(d, hn::BroadcastSignBit(hn::BitCast(s, index)));
    for (int k = 0; k < kDimensions; ++k) {
      sums[k] = hn::Xor(sums[k], hn::And(is_set, hn::Set(d, kColumns.of[k][bit])));
    }
    index = hn::Add(index, index);
  }
}

HWY_INLINE void StoreCanonical(Vu reversed, Vu key, float* u) {
  const hn::RebindToFloat<Words> f;
  const hn::RebindToSigned<Words> s;
  const Vu bits = hn::ShiftRight<8>(ReverseBits(LaineKarras(reversed, key)));
  hn::Store(hn::Mul(hn::ConvertTo(f, hn::BitCast(s, bits)), hn::Set(f, 0x1p-24f)), f, u);
}

template <int kDimensions>
HWY_INLINE void Draw(const SobolKeyTable& keys, const uint32_t* set, const uint32_t* reversed_index,
                     size_t count, SobolLanes& numbers) {
  const Words d;
  const hn::RebindToSigned<Words> s;
  static_assert(SobolKeyTable::kRowWords == 8);
  for (size_t k = 0; k < count; k += hn::Lanes(d)) {
    const auto row = hn::BitCast(s, hn::ShiftLeft<3>(hn::LoadU(d, set + k)));
    const auto key = [&](int word) HWY_ATTR { return hn::GatherIndex(d, keys.words() + word, row); };
    const Vu index = ReverseBits(LaineKarras(hn::LoadU(d, reversed_index + k), key(0)));
    Vu by_columns[2];
    SobolByColumns<kDimensions - 2>(index, by_columns);
    StoreCanonical(index, key(1), numbers.u[0] + k);
    StoreCanonical(SobolPascal(index), key(2), numbers.u[1] + k);
    StoreCanonical(by_columns[0], key(3), numbers.u[2] + k);
    if (kDimensions > 3) StoreCanonical(by_columns[1], key(4), numbers.u[3] + k);
  }
}

void DrawSobolLanes(const SobolKeyTable& keys, const uint32_t* set, const uint32_t* reversed_index,
                    size_t count, int dimensions, SobolLanes* numbers) {
  if (dimensions > 3) return Draw<4>(keys, set, reversed_index, count, *numbers);
  Draw<3>(keys, set, reversed_index, count, *numbers);
}

}  // namespace kaustik::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kaustik {

HWY_EXPORT(DrawSobolLanes);

void draw_sobol_lanes(const SobolKeyTable& keys, const uint32_t set[kSobolLanes],
                      const uint32_t reversed_index[kSobolLanes], size_t count, int dimensions,
                      SobolLanes* numbers) {
  HWY_DYNAMIC_DISPATCH(DrawSobolLanes)(keys, set, reversed_index, count, dimensions, numbers);
}

}  // namespace kaustik
#endif
