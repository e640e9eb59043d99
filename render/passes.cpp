#include "render/passes.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "photon/memory_forecast.h"
#include "render/photon_maps.h"

namespace kaustik::render {

PassRange pass_range(uint64_t pass, uint64_t passes, uint64_t photons, int spp) {
  // The remainder goes to the first passes.
  const auto first = [&](uint64_t whole, uint64_t i) {
    return whole / passes * i + std::min(i, whole % passes);
  };
  const auto samples = std::max(static_cast<uint64_t>(spp), passes);
  return {pass, passes, first(photons, pass + 1) - first(photons, pass),
          static_cast<int>(first(samples, pass)), static_cast<int>(first(samples, pass + 1))};
}

photon::TraceSettings trace_settings(const RenderSettings& settings, const EstimatorPlan& plan,
                                     const PassRange& pass) {
  photon::TraceSettings trace;
  trace.seed = settings.seed;
  trace.pass = pass.pass;
  trace.photons = pass.photons;
  trace.max_bounces = settings.max_bounces;
  trace.emission = settings.emission;
  trace.kinds = kinds_needed(plan);
  return trace;
}

uint64_t choose_passes(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                       EstimatorPlan* plan) {
  if (settings.passes > 0) {
    if (settings.passes > std::max<uint64_t>(1, settings.photons))
      throw std::invalid_argument("there must be at least as many photons as passes");
    const PassRange largest = pass_range(0, settings.passes, settings.photons, settings.spp);
    photon::check_memory(scene, bvh, trace_settings(settings, *plan, largest), photon::PhotonUse::kMaps,
                         settings.photon_memory);
    return settings.passes;
  }
  if (!kinds_needed(*plan).any()) return 1;
  const PassRange whole = pass_range(0, 1, settings.photons, settings.spp);
  const uint64_t passes =
      photon::shoots_that_fit(scene, bvh, trace_settings(settings, *plan, whole), settings.photon_memory);
  if (passes > std::numeric_limits<int>::max()) {  // a sample of each pixel in each
    throw std::runtime_error(
        fmt::format("{} photons would need {} passes to fit into memory", settings.photons, passes));
  }
  if (passes > 1) {
    plan->notes.push_back(
        fmt::format("the photons come in {} passes, since the maps of all would not fit into "
                    "memory{}",
                    passes, passes > uint64_t(settings.spp) ? ", with one sample each" : ""));
  }
  return passes;
}

}  // namespace kaustik::render
