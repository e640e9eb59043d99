#pragma once
// The runs of a benchmark: the same render again and again, on one scene in memory.

#include <functional>

#include "apps/bench/bench_result.h"
#include "apps/session/render_job.h"
#include "core/scene/scene.h"
#include "render/settings.h"

namespace kaustik::app {

struct BenchPlan {
  std::vector<uint64_t> photons;
  std::vector<int> threads;
  uint64_t repeat = 5;

  uint64_t runs() const { return photons.size() * threads.size() * repeat; }
};

// Asked for often, from worker threads too, with the runs that are done; false cancels.
using BenchProgress = std::function<bool(uint64_t done)>;

// By Phase; the total is the sum of the others.
std::array<double, kPhases> phase_seconds(const RenderOutcome& outcome);

// Every round renders each point once, so that a machine that slows down does so for all alike. A run builds
// the rays' tree and the photon maps anew and renders the image; nothing is written. Fills BenchPoint's
// fields. Nothing when cancelled. Throws std::runtime_error when runs of the same photons count differently.
std::optional<std::vector<BenchPoint>> measure(const Scene& scene, const render::RenderSettings& settings,
                                               const BenchPlan& plan, const BenchProgress& progress);

}  // namespace kaustik::app
