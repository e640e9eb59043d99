// The number of passes that memory requires.

#include "render/passes/passes.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "core/memory/memory_room.h"
#include "photon/shoot/memory_estimate.h"
#include "render/maps/photon_shoots.h"
#include "render/passes/pass_set.h"
#include "render/plan/pass_share.h"

namespace kaustik::render {

namespace {

// What several passes leave to the photons of each.
uint64_t memory_in_passes(const RenderSettings& settings) {
  return settings.photon_memory - std::min(settings.photon_memory, settings.sums_memory);
}

[[noreturn]] void refuse_sums(const RenderSettings& settings) {
  throw std::runtime_error(fmt::format(
      "not enough memory: {} photons do not fit into the {} that a single pass leaves to them, and the sums "
      "that several passes keep take {}: emit fewer photons, or render a smaller picture or parts of it",
      settings.photons, size_text(settings.photon_memory), size_text(settings.sums_memory)));
}

}  // namespace

uint64_t choose_passes(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                       EstimatorPlan* plan) {
  if (settings.passes > 0) {
    if (kinds_needed(*plan).any() && settings.passes > settings.photons)
      throw std::invalid_argument("there must be at least as many photons as passes");
    const PassShare each = pass_share(0, settings.passes, most_photons(settings), settings.spp);
    photon::check_memory(scene, bvh, trace_settings(settings, *plan, each), photon::PhotonUse::kMaps,
                         settings.passes > 1 ? memory_in_passes(settings) : settings.photon_memory,
                         may_be_guided(settings, *plan, each.photons));
    return settings.passes;
  }
  if (!kinds_needed(*plan).any()) return 1;
  const PassShare whole = pass_share(0, 1, most_photons(settings), settings.spp);
  const auto passes_in = [&](uint64_t memory) {
    return photon::shoots_that_fit(scene, bvh, trace_settings(settings, *plan, whole), memory,
                                   may_be_guided(settings, *plan, whole.photons));
  };
  uint64_t passes = passes_in(settings.photon_memory);
  if (passes > 1 && settings.sums_memory > 0) {
    const uint64_t left = memory_in_passes(settings);
    if (left == 0) refuse_sums(settings);
    passes = passes_in(left);
  }
  if (passes > kMostPasses) {  // each takes a sample of each pixel
    throw std::runtime_error(fmt::format(
        "{} photons would need {} passes to fit into memory, which is too many", settings.photons, passes));
  }
  if (passes > 1) {
    plan->notes.push_back(fmt::format(
        "the photons are divided into {} passes, since the maps of all of them would not fit into "
        "memory{}",
        passes, passes > uint64_t(settings.spp) ? "; each takes one sample per pixel" : ""));
  }
  return passes;
}

}  // namespace kaustik::render
