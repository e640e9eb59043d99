#pragma once
// The parallel shoot: photons are traced in fixed blocks of indices, each into its own buffer, and joined in
// block order. The result does not depend on the number of threads.

#include <algorithm>
#include <array>
#include <functional>

#include "photon/record/photon_record.h"
#include "photon/trace/tracer.h"

namespace kaustik::photon {

struct ShootResult {
  std::array<PhotonBuffer, kPhotonKinds> buffers;  // indexed by PhotonKind
  TraceCounters counters;                          // counters.emitted < settings.photons when cancelled
};

// Photons per block, chosen so that its records stay in the caches until they are joined.
inline constexpr uint64_t kShootBlock = 1u << 12;
// Photons per block where few are traced to learn something: as many blocks as large machines have cores.
inline constexpr uint64_t kLearnBlock = 1u << 8;

// Unit of flux in the compact records: the power of two near the mean flux of one photon.
float flux_unit_of(const Scene& scene, uint64_t photons);

// Where few photons become caustics in media, these leave many on each of their segments, which costs little
// and takes most of the noise: until there are half as many as photons are emitted, so that the other maps
// are still the larger ones, and at most kMostOnSegment on a segment.
inline constexpr double kSegmentPhotons = 0.5;
inline constexpr uint64_t kMostOnSegment = 64;

// TraceSettings::photons_on_segments for a render in which `photons` emitted photons have `segments` in
// media.
inline uint32_t photons_on_segments(uint64_t photons, uint64_t segments) {
  const auto all = static_cast<uint64_t>(kSegmentPhotons * static_cast<double>(photons));
  return static_cast<uint32_t>(
      std::clamp<uint64_t>(all / std::max<uint64_t>(1, segments), 1, kMostOnSegment));
}

// progress(done, total) is called from worker threads, one call at a time, as blocks finish in order.
// Returning false cancels the shoot.
using ShootProgress = std::function<bool(uint64_t done, uint64_t total)>;

// Traces photons 0 ... settings.photons - 1 on the calling arena's threads. The order of the photons of a
// kind is a pure function of (scene, settings). Peak memory is that of the result plus a few blocks per
// thread. A cancelled shoot returns the photons of the finished blocks, with flux divided by settings.photons
// as if all had been emitted. Emits nothing when no kind is requested.
ShootResult shoot(const Scene& scene, const accel::Bvh& bvh, const TraceSettings& settings,
                  const ShootProgress& progress = {});

}  // namespace kaustik::photon
