#include "render/maps/pilot_photons.h"

#include <algorithm>

#include "core/parallel/parallel.h"
#include "photon/shoot/shoot.h"

namespace kaustik::render {

PilotPhotons shoot_pilot(const RenderInput& input, const photon::TraceSettings& trace) {
  const photon::SurfaceTable surfaces(input.scene);
  const uint64_t blocks = trace.photons / photon::kLearnBlock;
  std::vector<PilotPhotons> of_block(blocks);
  parallel::for_index(uint64_t{0}, blocks, [&](uint64_t block) {
    const uint64_t first = block * photon::kLearnBlock;
    PilotPhotons& pilot = of_block[block];
    const auto sink = [&](photon::PhotonKind kind, const photon::Photon& photon, uint64_t index) {
      pilot.left.push_back({photon, kind, uint32_t(index)});
    };
    trace_photons(input.scene, surfaces, input.bvh, trace, first, first + photon::kLearnBlock, sink,
                  pilot.counters);
    std::ranges::stable_sort(pilot.left, {}, &PilotPhotons::Left::index);
  });
  PilotPhotons all;
  for (const PilotPhotons& pilot : of_block) {
    all.left.insert(all.left.end(), pilot.left.begin(), pilot.left.end());
    all.counters += pilot.counters;
  }
  return all;
}

}  // namespace kaustik::render
