#pragma once
// Few photons that are not counted, shot to learn from what they leave.

#include <vector>

#include "photon/trace/tracer.h"
#include "render/plan/render_input.h"

namespace kaustik::render {

struct PilotPhotons {
  struct Left {
    photon::Photon photon;
    photon::PhotonKind kind;
    uint32_t index;
  };
  std::vector<Left> left;  // in the order of the photons' indices, those of one index in that of its path
  // By index, what meet_source() of the tracer's sink receives; NaN where it receives nothing.
  std::vector<float> glossy_radiance;
  photon::TraceCounters counters;

  std::vector<photon::Photon> of(auto&& wanted) const {
    std::vector<photon::Photon> photons;
    for (const Left& l : left)
      if (wanted(l.kind)) photons.push_back(l.photon);
    return photons;
  }
};

// trace.photons: a multiple of photon::kLearnBlock.
PilotPhotons shoot_pilot(const RenderInput& input, const photon::TraceSettings& trace);

}  // namespace kaustik::render
