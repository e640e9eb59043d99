#pragma once
// How many photons of each kind are worth their time.

#include "photon/trace/trace_settings.h"
#include "render/explore/visible_points.h"

namespace kaustik::render {

// Photons to emit for a kind, as multiples of RenderSettings::photons.
struct PhotonCounts {
  static constexpr double kMost = 4;        // photons that are emitted
  static constexpr double kMostStored = 2;  // photons that are stored, as far as few of them tell
  double caustic = 0, indirect = 0;
};

// Upper bound of the photons of each kind that are stored where one is stored for each that is emitted.
inline uint64_t most_photons(const RenderSettings& settings) {
  return settings.balance == Balance::kOn ? uint64_t(PhotonCounts::kMostStored) * settings.photons
                                          : settings.photons;
}

// What few photons of a shoot tell about a kind.
struct PhotonNeed {
  double emitted = 0;  // multiple of RenderSettings::photons that is worth its time
  double rays = 0;     // of a photon
};

// points: where light is seen. trace: the shoot, of which the number of photons is ignored. A function of
// scene and settings.
PhotonNeed photons_needed(const RenderInput& input, const std::vector<VisiblePoint>& points,
                          photon::TraceSettings trace, photon::PhotonKind kind);

// What is needed, as far as it does not take too many rays. A kind that is not shot needs none. together:
// whether the two kinds share a shoot.
PhotonCounts within_limits(const PhotonNeed& caustic, const PhotonNeed& indirect, bool together);

}  // namespace kaustik::render
