#pragma once
// Estimates from a small shoot whether the photons of a large one will fit in memory.

#include <array>

#include "photon/shoot/shoot.h"

namespace kaustik::photon {

// What happens to the photons: they stay records, or become maps, one kind after the other.
enum class PhotonUse { kRecords, kMaps };

// Photons emitted for the estimate.
inline constexpr uint64_t kEstimatePhotons = 1u << 16;

// Estimates how many photons of each kind shoot() will store, from a shoot of kEstimatePhotons. n counted
// photons give a relative standard error near 1/sqrt(n).
std::array<double, kPhotonKinds> estimate_stored(const Scene& scene, const accel::Bvh& bvh,
                                                 const TraceSettings& settings);

// What guided emission may leave in place of a shoot's photons.
struct GuidedPhotons {
  uint64_t caustic = 0;
  bool indirect = false;  // whether each photon may start where it leaves indirect ones
};

// Peak memory in bytes for this many stored photons of each kind.
double peak_bytes(const std::array<double, kPhotonKinds>& stored, PhotonUse use);

// Peak memory in bytes of a shoot, from a small one.
uint64_t forecast_bytes(const Scene& scene, const accel::Bvh& bvh, const TraceSettings& settings,
                        PhotonUse use, const GuidedPhotons& guided = {});

// Throws std::runtime_error when the photons will need more than `limit` bytes, or when a map would hold more
// than it can index; the message says how much, and how many photons to emit at most. Traces the small shoot
// only if the upper bound of stored photons does not fit.
void check_memory(const Scene& scene, const accel::Bvh& bvh, const TraceSettings& settings, PhotonUse use,
                  uint64_t limit, const GuidedPhotons& guided = {});

// Returns the smallest number of shoots, of equal shares of settings.photons, such that the maps of each need
// at most `limit` bytes. Guided photons are divided among the shoots, too. Throws std::runtime_error when
// there is no such number, because a single photon needs more.
uint64_t shoots_that_fit(const Scene& scene, const accel::Bvh& bvh, const TraceSettings& settings,
                         uint64_t limit, const GuidedPhotons& guided = {});

}  // namespace kaustik::photon
