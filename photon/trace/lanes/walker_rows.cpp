// Transposes photons between rows and columns in SIMD lanes (Google Highway).

#include "photon/trace/lanes/walker_rows.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "photon/trace/lanes/walker_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace kaustik::photon::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::CappedTag<uint32_t, WalkerLanes::kLanes>;
using Floats = hn::RebindToFloat<Words>;
using Ints = hn::RebindToSigned<Words>;
using Vu = hn::Vec<Words>;
using Columns3 = float[3][WalkerLanes::kLanes];

HWY_INLINE Vu LoadBits(const float* column) {
  return hn::BitCast(Words(), hn::Load(Floats(), column));
}
HWY_INLINE void StoreBits(Vu bits, float* column) {
  hn::Store(hn::BitCast(Floats(), bits), Floats(), column);
}

void ToRows(const accel::RayLanes& rays, const Columns3& flux, const WalkerLanes& walkers, size_t count,
            WalkerRows& rows) {
  const Words w;
  const uint32_t* state = WalkState::words(walkers.state);
  for (size_t k = 0; k < count; k += hn::Lanes(w)) {
    const Vu x = LoadBits(rays.d[0] + k), y = LoadBits(rays.d[1] + k), z = LoadBits(rays.d[2] + k);
    hn::StoreInterleaved4(LoadBits(rays.o[0] + k), LoadBits(rays.o[1] + k), LoadBits(rays.o[2] + k), x, w,
                          rows.part[0][k]);
    hn::StoreInterleaved4(y, z, LoadBits(flux[0] + k), LoadBits(flux[1] + k), w, rows.part[1][k]);
    hn::StoreInterleaved4(LoadBits(flux[2] + k), hn::Load(w, walkers.reversed_index + k),
                          hn::Load(w, state + k), hn::BitCast(w, hn::Load(Ints(), walkers.energy + k)), w,
                          rows.part[2][k]);
    const Vu y_bit = hn::ShiftLeft<1>(hn::ShiftRight<31>(y)), z_bit = hn::ShiftLeft<2>(hn::ShiftRight<31>(z));
    hn::Store(hn::Or(hn::ShiftRight<31>(x), hn::Or(y_bit, z_bit)), w, rows.octant + k);
  }
}

void FromRows(const uint32_t* const (&part)[3], size_t count, accel::RayLanes& rays, Columns3& flux,
              WalkerLanes& walkers) {
  const Words w;
  uint32_t* state = WalkState::words(walkers.state);
  Vu a, b, c, d;
  for (size_t k = 0; k < count; k += hn::Lanes(w)) {
    hn::LoadInterleaved4(w, part[0] + 4 * k, a, b, c, d);
    StoreBits(a, rays.o[0] + k);
    StoreBits(b, rays.o[1] + k);
    StoreBits(c, rays.o[2] + k);
    StoreBits(d, rays.d[0] + k);
    hn::LoadInterleaved4(w, part[1] + 4 * k, a, b, c, d);
    StoreBits(a, rays.d[1] + k);
    StoreBits(b, rays.d[2] + k);
    StoreBits(c, flux[0] + k);
    StoreBits(d, flux[1] + k);
    hn::LoadInterleaved4(w, part[2] + 4 * k, a, b, c, d);
    StoreBits(a, flux[2] + k);
    hn::Store(b, w, walkers.reversed_index + k);
    hn::Store(c, w, state + k);
    hn::Store(hn::BitCast(Ints(), d), Ints(), walkers.energy + k);
  }
}

}  // namespace kaustik::photon::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kaustik::photon {

HWY_EXPORT(ToRows);
HWY_EXPORT(FromRows);

void to_rows(const accel::RayLanes& rays, const float (&flux)[3][WalkerLanes::kLanes],
             const WalkerLanes& walkers, size_t count, WalkerRows* rows) {
  HWY_DYNAMIC_DISPATCH(ToRows)(rays, flux, walkers, count, *rows);
}

void from_rows(const uint32_t* const (&part)[3], size_t count, accel::RayLanes* rays,
               float (&flux)[3][WalkerLanes::kLanes], WalkerLanes* walkers) {
  HWY_DYNAMIC_DISPATCH(FromRows)(part, count, *rays, flux, *walkers);
}

}  // namespace kaustik::photon
#endif
