#include "apps/bench/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "apps/machine/energy.h"
#include "apps/machine/peak_memory.h"
#include "apps/machine/thread_limit.h"
#include "apps/machine/waiting.h"
#include "apps/session/render_job.h"
#include "core/stopwatch.h"

namespace kaustik::app {

namespace {

struct Run {
  std::array<double, kPhases> seconds{};
  std::array<double, kRates> per_second{};
  double busy_cores = 0;
  std::optional<double> waiting, joules;
  double peak_memory_bytes = 0;
  Json counters;
};

// All runs of one point of the benchmark.
struct PointRuns {
  uint64_t photons = 1;
  int threads = 1;
  uint64_t photons_per_thread = 0;
  std::vector<Run> runs{};
};

std::array<double, kRates> rates_of(const render::RenderStatistics& s) {
  const auto rate = [](uint64_t n, double seconds) {
    return seconds > 0 ? static_cast<double>(n) / seconds : 0.0;
  };
  const auto traced = [&](uint64_t n) { return rate(n, s.photon_trace_s); };
  const auto rendered = [&](uint64_t n) { return rate(n, s.render_s); };
  return {traced(s.photons.emitted + s.guided.emitted),
          traced(s.photons.rays + s.guided.rays),
          traced(s.photons.shadow_rays),
          rendered(s.rays.camera),
          rendered(s.rays.specular),
          rendered(s.rays.shadow),
          rendered(s.rays.bounce),
          rendered(s.gather_queries),
          rendered(s.gather_candidates)};
}

// CPU time of all threads of the process.
double cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::optional<Run> run_once(const Scene& scene, render::RenderSettings settings, const PointRuns& point,
                            const render::ProgressCallback& go_on) {
  settings.photons = point.photons;
  settings.balance = render::Balance::kOff;
  settings.threads = point.threads;
  std::optional<Run> run;
  with_thread_limit(point.threads, [&] {
    restart_peak_memory();
    EnergyMeter energy;
    const Stopwatch watch;
    const double cpu_before = cpu_seconds();
    const std::optional<double> waited_before = waiting_seconds();
    const RenderOutcome outcome = render_job(scene, settings, go_on, {.keep_sums = false});
    const double cpu = cpu_seconds() - cpu_before, busy = cpu / watch.seconds();
    const std::optional<double> waited_after = waiting_seconds();
    if (outcome.result.cancelled) return;
    std::optional<double> waiting;
    // Threads that have ended meanwhile took their counts with them.
    if (waited_before && waited_after) {
      const double waited = std::max(*waited_after - *waited_before, 0.0);
      waiting = waited / (waited + cpu);
    }
    run = Run{phase_seconds(outcome),
              rates_of(outcome.result.statistics),
              busy,
              waiting,
              energy.joules(),
              static_cast<double>(render::peak_memory_bytes()),
              render::counters_json(outcome.result.statistics)};
  });
  return run;
}

// Checks that the counters do not depend on the number of threads, as the renderer promises.
void check_counters(const std::vector<PointRuns>& all, const PointRuns& point, const Json& counters) {
  for (const PointRuns& other : all) {
    if (other.photons != point.photons || other.runs.empty() || other.runs.front().counters == counters)
      continue;
    throw std::runtime_error(
        fmt::format("the counters for {} photons differ between {} and {} threads: {} and {}", point.photons,
                    other.threads, point.threads, other.runs.front().counters.dump(), counters.dump()));
  }
}

std::vector<PointRuns> points_of(const BenchPlan& plan) {
  std::vector<PointRuns> points;
  for (const uint64_t photons : plan.photons)
    for (const int threads : plan.threads) points.push_back({photons, threads});
  for (const uint64_t each : plan.photons_per_thread)
    for (const int threads : plan.threads) points.push_back({each * uint64_t(threads), threads, each});
  return points;
}

BenchPoint summarise(const PointRuns& point) {
  const auto spread = [&](const auto& value) {
    std::vector<double> values;
    for (const Run& run : point.runs) values.push_back(value(run));
    return spread_of(std::move(values));
  };
  BenchPoint out;
  out.photons = point.photons;
  out.threads = point.threads;
  out.photons_per_thread = point.photons_per_thread;
  for (size_t i = 0; i < kPhases; ++i) out.seconds[i] = spread([i](const Run& r) { return r.seconds[i]; });
  for (size_t i = 0; i < kRates; ++i)
    out.per_second[i] = spread([i](const Run& r) { return r.per_second[i]; });
  out.busy_cores = spread([](const Run& r) { return r.busy_cores; });
  const auto spread_if_known = [&](std::optional<double> Run::*value) -> std::optional<Spread> {
    for (const Run& run : point.runs)
      if (!(run.*value)) return std::nullopt;
    return spread([&](const Run& run) { return *(run.*value); });
  };
  out.waiting = spread_if_known(&Run::waiting);
  out.joules = spread_if_known(&Run::joules);
  out.peak_memory_bytes = spread([](const Run& r) { return r.peak_memory_bytes; });
  out.counters = point.runs.front().counters;
  return out;
}

}  // namespace

std::array<double, kPhases> phase_seconds(const RenderOutcome& outcome) {
  const render::RenderStatistics& s = outcome.result.statistics;
  const double bvh = outcome.times.bvh;
  return {bvh, s.photon_trace_s, s.photon_build_s, s.render_s,
          bvh + s.photon_trace_s + s.photon_build_s + s.render_s};
}

std::optional<std::vector<BenchPoint>> measure(const Scene& scene, const render::RenderSettings& settings,
                                               const BenchPlan& plan, const BenchProgress& progress) {
  std::vector<PointRuns> points = points_of(plan);
  uint64_t done = 0;
  for (uint64_t round = 0; round < plan.repeat; ++round) {
    for (PointRuns& point : points) {
      const auto go_on = [&](const render::Progress&) { return progress(done); };
      std::optional<Run> run = run_once(scene, settings, point, go_on);
      if (!run) return std::nullopt;
      check_counters(points, point, run->counters);
      point.runs.push_back(std::move(*run));
      if (!progress(++done)) return std::nullopt;
    }
  }
  std::vector<BenchPoint> out;
  for (const PointRuns& point : points) out.push_back(summarise(point));
  return out;
}

}  // namespace kaustik::app
