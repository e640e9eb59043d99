#include "render/maps/pilot_photons.h"

#include <algorithm>
#include <limits>

#include "core/parallel/parallel.h"
#include "photon/shoot/shoot.h"

namespace kaustik::render {

namespace {

// Keeps what the photons from `first` on leave.
struct Keep {
  uint64_t first;
  PilotPhotons& to;

  void operator()(photon::PhotonKind kind, const photon::Photon& photon, uint64_t index) const {
    to.left.push_back({photon, kind, uint32_t(index)});
  }
  void meet_source(uint64_t index, float L) const { to.glossy_radiance[index - first] = L; }
};

}  // namespace

PilotPhotons shoot_pilot(const RenderInput& input, const photon::TraceSettings& trace) {
  const photon::SurfaceTable surfaces(input.scene);
  const uint64_t blocks = trace.photons / photon::kLearnBlock;
  std::vector<PilotPhotons> of_block(blocks);
  parallel::for_index(uint64_t{0}, blocks, [&](uint64_t block) {
    const uint64_t first = block * photon::kLearnBlock;
    PilotPhotons& pilot = of_block[block];
    pilot.glossy_radiance.assign(photon::kLearnBlock, std::numeric_limits<float>::quiet_NaN());
    trace_photons(input.scene, surfaces, input.bvh, trace, first, first + photon::kLearnBlock,
                  Keep{first, pilot}, pilot.counters);
    std::ranges::stable_sort(pilot.left, {}, &PilotPhotons::Left::index);
  });
  PilotPhotons all;
  for (const PilotPhotons& pilot : of_block) {
    all.left.insert(all.left.end(), pilot.left.begin(), pilot.left.end());
    all.glossy_radiance.insert(all.glossy_radiance.end(), pilot.glossy_radiance.begin(),
                               pilot.glossy_radiance.end());
    all.counters += pilot.counters;
  }
  return all;
}

}  // namespace kaustik::render
