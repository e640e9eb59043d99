#pragma once
// Photons of a single pass that were shot by an earlier render.

#include <array>

#include "photon/map/photon_map.h"
#include "photon/trace/trace_settings.h"
#include "render/maps/gather_radii.h"
#include "render/statistics/statistics.h"

namespace kaustik::render {

// Maps of kinds that were not shot are empty. Copies share the photons.
struct KeptPhotons {
  std::array<photon::PhotonMap, photon::kPhotonKinds> maps{};  // indexed by PhotonKind
  GatherRadii radii{};
  RenderStatistics statistics{};  // of the photons
};

}  // namespace kaustik::render
