#pragma once
// Runs a benchmark: repeats the same render with one scene in memory.

#include <functional>

#include "apps/bench/bench_result.h"
#include "apps/session/render_job.h"
#include "core/scene/scene.h"
#include "render/settings/settings.h"

namespace kaustik::app {

struct BenchPlan {
  std::vector<uint64_t> photons, photons_per_thread;
  std::vector<int> threads;
  uint64_t repeat = 5;

  uint64_t runs() const { return (photons.size() + photons_per_thread.size()) * threads.size() * repeat; }
};

// Receives the number of finished runs; returning false cancels. Called often, also from worker threads.
using BenchProgress = std::function<bool(uint64_t done)>;

// The seconds of a render by Phase; the total is the sum of the others.
std::array<double, kPhases> phase_seconds(const RenderOutcome& outcome);

// Measures all points. Each round renders every point once, so that changes in the machine's speed affect all
// points alike. A run builds the BVH and the photon maps anew and renders the image without writing it.
// Nothing when cancelled. Throws std::runtime_error when the counters of runs with the same photon count
// differ.
std::optional<std::vector<BenchPoint>> measure(const Scene& scene, const render::RenderSettings& settings,
                                               const BenchPlan& plan, const BenchProgress& progress);

}  // namespace kaustik::app
