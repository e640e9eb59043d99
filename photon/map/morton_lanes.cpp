// MortonCube::quantise and spread_bits in SIMD lanes (Google Highway).

#include "photon/map/morton_lanes.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "photon/map/morton_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kaustik::photon::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Keys = hn::CappedTag<uint64_t, 8>;
using Floats = hn::Rebind<float, Keys>;
using Ints = hn::Rebind<int32_t, Keys>;
using Words = hn::Rebind<uint32_t, Keys>;
using Vk = hn::Vec<Keys>;

HWY_INLINE Vk SpreadBits(Vk x) {
  const Keys d;
  x = hn::And(hn::Or(x, hn::ShiftLeft<32>(x)), hn::Set(d, 0x001f00000000ffffull));
  x = hn::And(hn::Or(x, hn::ShiftLeft<16>(x)), hn::Set(d, 0x001f0000ff0000ffull));
  x = hn::And(hn::Or(x, hn::ShiftLeft<8>(x)), hn::Set(d, 0x100f00f00f00f00full));
  x = hn::And(hn::Or(x, hn::ShiftLeft<4>(x)), hn::Set(d, 0x10c30c30c30c30c3ull));
  return hn::And(hn::Or(x, hn::ShiftLeft<2>(x)), hn::Set(d, 0x1249249249249249ull));
}

HWY_INLINE Vk SpreadCells(const MortonCube& cube, const float* p, int axis) {
  const Floats d;
  const auto t =
      hn::Mul(hn::Sub(hn::LoadU(d, p), hn::Set(d, cube.origin[axis])), hn::Set(d, cube.cells_per_metre));
  const auto cell = hn::IfThenElseZero(hn::Gt(t, hn::Zero(d)), hn::Min(t, hn::Set(d, float(kMortonMax))));
  return SpreadBits(hn::PromoteTo(Keys(), hn::BitCast(Words(), hn::ConvertTo(Ints(), cell))));
}

// Computes as many keys as fill whole vectors, and returns their number.
size_t MortonKeys(const MortonCube& cube, const float* x, const float* y, const float* z, size_t count,
                  uint64_t* keys) {
  const Keys d;
  size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
    const Vk yz =
        hn::Or(hn::ShiftLeft<1>(SpreadCells(cube, y + i, 1)), hn::ShiftLeft<2>(SpreadCells(cube, z + i, 2)));
    hn::StoreU(hn::Or(SpreadCells(cube, x + i, 0), yz), d, keys + i);
  }
  return i;
}

}  // namespace kaustik::photon::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kaustik::photon {

HWY_EXPORT(MortonKeys);

void morton_keys(const MortonCube& cube, const float* x, const float* y, const float* z,
                 std::span<uint64_t> keys) {
  size_t i = HWY_DYNAMIC_DISPATCH(MortonKeys)(cube, x, y, z, keys.size(), keys.data());
  for (; i < keys.size(); ++i) keys[i] = morton_key(cube.cell({x[i], y[i], z[i]}));
}

void morton_keys(const MortonCube& cube, const PhotonRecord* records, std::span<uint64_t> keys) {
  constexpr size_t kPart = 256;  // chosen so that the columns fit into the L1 cache
  float x[kPart], y[kPart], z[kPart];
  for (size_t begin = 0; begin < keys.size(); begin += kPart) {
    const size_t count = std::min(kPart, keys.size() - begin);
    for (size_t i = 0; i < count; ++i) {
      x[i] = records[begin + i].x;
      y[i] = records[begin + i].y;
      z[i] = records[begin + i].z;
    }
    morton_keys(cube, x, y, z, keys.subspan(begin, count));
  }
}

}  // namespace kaustik::photon
#endif
