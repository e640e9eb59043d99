#pragma once
// Do the photons of a shoot fit in memory? Predicted from a small shoot, before the large one has taken it.

#include <array>

#include "photon/shoot/shoot.h"

namespace kaustik::photon {

// What is made of the photons: they stay as they were shot, or become maps, one after the other.
enum class PhotonUse { kRecords, kMaps };

// Emitted for the forecast.
inline constexpr uint64_t kForecastPhotons = 1u << 16;

// Photons of each kind that shoot() will store, counted in a shoot of kForecastPhotons: n of them predict
// with a relative standard error near 1/sqrt(n).
std::array<double, kPhotonKinds> forecast_stored(const Scene& scene, const accel::Bvh& bvh,
                                                 const TraceSettings& settings);

// Bytes at the peak, for so many stored photons of each kind.
double peak_bytes(const std::array<double, kPhotonKinds>& stored, PhotonUse use);

// Throws std::runtime_error when the photons will need more than `limit` bytes, or a map would hold more than
// it can number: the message says how much, and how many photons to emit at most. Costs a forecast, or
// nothing where even the most photons that could be stored fit. guided: caustic photons that guided emission
// may leave in place of those of this shoot.
void check_memory(const Scene& scene, const accel::Bvh& bvh, const TraceSettings& settings, PhotonUse use,
                  uint64_t limit, uint64_t guided = 0);

// The smallest number of shoots, of equal shares of settings.photons, such that the maps of each need at most
// `limit` bytes. Throws std::runtime_error when there is no such number, because a single photon needs more.
// guided: as above, shared out likewise.
uint64_t shoots_that_fit(const Scene& scene, const accel::Bvh& bvh, const TraceSettings& settings,
                         uint64_t limit, uint64_t guided = 0);

}  // namespace kaustik::photon
