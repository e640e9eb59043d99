// Ledger energy of fluxes in SIMD lanes, compiled once per instruction set by foreach_target.h.

#if defined(KAUSTIK_ENERGY_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef KAUSTIK_ENERGY_LANES
#undef KAUSTIK_ENERGY_LANES
#else
#define KAUSTIK_ENERGY_LANES
#endif

#include "photon/lanes/vector_lanes-inl.h"
#include "photon/trace/energy/energy_ledger.h"

HWY_BEFORE_NAMESPACE();
namespace kaustik::photon::HWY_NAMESPACE {

// Same operations as energy_of().
HWY_INLINE hn::Vec<hn::RebindToSigned<Floats>> Energy(const Vec3<Vf>& flux, Vf units_per_watt) {
  const Vf sum = hn::Add(hn::Add(flux.x, flux.y), flux.z);
  return hn::NearestInt(hn::Min(hn::Mul(sum, units_per_watt), hn::Set(Floats(), kMostEnergy)));
}

}  // namespace kaustik::photon::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
