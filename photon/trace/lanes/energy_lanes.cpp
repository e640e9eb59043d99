// Energy booking in SIMD lanes (Google Highway). Energies are integers, so the result is the same on every
// instruction set.

#include "photon/trace/lanes/energy_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "photon/trace/lanes/energy_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "photon/trace/energy/energy_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace kaustik::photon::HWY_NAMESPACE {

void ToEnergyLanes(const Columns3& flux, size_t count, float units_per_watt,
                   int32_t (&energy)[kPhotonLanes]) {
  const Floats d;
  const hn::RebindToSigned<Floats> i;
  const Vf scale = hn::Set(d, units_per_watt);
  for (size_t k = 0; k < count; k += hn::Lanes(d)) hn::Store(Energy(Load(flux, k), scale), i, energy + k);
}

void BookLanes(const VertexLanes& lanes, const uint8_t (&scatters)[kPhotonLanes], WalkerLanes& walkers,
               EnergyLedger& ledger) {
  const hn::RebindToSigned<Floats> i;
  const hn::RebindToUnsigned<Floats> words;
  const hn::Rebind<uint8_t, decltype(i)> bytes;
  auto all = hn::Zero(i), escaped = all, scattering = all, scattered = all, next = all;
  for (size_t k = 0; k < kPhotonLanes; k += hn::Lanes(i)) {
    const auto energy = hn::Load(i, walkers.energy + k);
    const auto scatter = hn::Ne(hn::PromoteTo(i, hn::Load(bytes, scatters + k)), hn::Zero(i));
    const auto missed =
        hn::RebindMask(i, hn::TestBit(hn::Load(words, lanes.traits + k), hn::Set(words, kMissedTrait)));
    const auto goes_on = hn::IfThenElseZero(scatter, hn::Load(i, lanes.next_energy + k));
    all = hn::Add(all, energy);
    escaped = hn::Add(escaped, hn::IfThenElseZero(missed, energy));
    scattering = hn::Add(scattering, hn::IfThenElseZero(scatter, energy));
    scattered = hn::Add(scattered, hn::IfThenElseZero(scatter, hn::Load(i, lanes.scattered_energy + k)));
    next = hn::Add(next, goes_on);
    hn::Store(goes_on, i, walkers.energy + k);
  }
  // A group holds at most 64 * 2^24 units: no overflow.
  const auto sum = [&](auto v) HWY_ATTR { return int64_t{hn::GetLane(hn::SumOfLanes(i, v))}; };
  const int64_t gone = sum(escaped), met = sum(scattering), left = sum(scattered);
  ledger.escaped += gone;
  ledger.terminated += sum(all) - gone - met;
  ledger.absorbed += met - left;
  ledger.roulette += left - sum(next);
}

}  // namespace kaustik::photon::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kaustik::photon {

HWY_EXPORT(ToEnergyLanes);
HWY_EXPORT(BookLanes);

void to_energy_lanes(const float (&flux)[3][kPhotonLanes], size_t count, float units_per_watt,
                     int32_t (&energy)[kPhotonLanes]) {
  HWY_DYNAMIC_DISPATCH(ToEnergyLanes)(flux, count, units_per_watt, energy);
}

void book_lanes(const VertexLanes& lanes, const uint8_t (&scatters)[kPhotonLanes], WalkerLanes& walkers,
                EnergyLedger& ledger) {
  HWY_DYNAMIC_DISPATCH(BookLanes)(lanes, scatters, walkers, ledger);
}

}  // namespace kaustik::photon
#endif
