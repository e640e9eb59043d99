// Fixed work on the photon engine by one thread, which scripts/perf-gate compares between two revisions.
//
//   perf_kernels --once KERNEL       one small run, for callgrind with --toggle-collect=counted_work, which
//                                    counts the instructions of that function and of what it calls
//   perf_kernels [--benchmark_...]   all kernels on larger inputs, as Google Benchmarks
//
// It is built against the libraries of both revisions: use only calls that rarely change.

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <cstdio>
#include <functional>
#include <memory>
#include <string_view>

#include "benchmarks/perf/kernel_scene.h"
#include "benchmarks/wall_photons.h"
#include "photon/gather/gather.h"
#include "photon/gather/nearest.h"
#include "photon/map/photon_map.h"
#include "photon/shoot/shoot.h"

// callgrind refers to this name. The barrier keeps the call from becoming a jump, after which callgrind would
// not see this function end.
extern "C" [[gnu::noinline]] void counted_work(const std::function<void()>& work) {
  work();
  asm volatile("" ::: "memory");
}

namespace kaustik::benchmarks {
namespace {

struct Size {
  uint64_t traced;        // photons emitted
  size_t mapped;          // photons in the map
  size_t tiles_per_axis;  // of 256 queries each
};
constexpr Size kCounted{16'384, 200'000, 4}, kTimed{131'072, 1'000'000, 6};

struct Kernel {
  std::function<void()> work;
  std::function<void()> prepare = [] {};  // called before each run; not counted
};

// Emission, tracing and records of all kinds.
Kernel shoot_kernel(const Size& size) {
  struct State {
    Scene scene = kernel_scene();
    accel::Bvh bvh{scene};
    photon::TraceSettings settings;
  };
  const auto state = std::make_shared<State>();
  state->settings.photons = size.traced;
  state->settings.kinds = {true, true, true, true};
  return {[state] { benchmark::DoNotOptimize(photon::shoot(state->scene, state->bvh, state->settings)); }};
}

// Keys, sort, octree, columns.
Kernel build_kernel(const Size& size) {
  const auto from = std::make_shared<photon::PhotonBuffer>(wall_photons(size.mapped));
  const auto copy = std::make_shared<photon::PhotonBuffer>();
  return {[copy] { benchmark::DoNotOptimize(photon::PhotonMap::build(std::move(*copy))); },
          [from, copy] { *copy = *from; }};
}

struct Queries {
  photon::PhotonMap map;
  std::vector<photon::GatherQuery> queries;
};

std::shared_ptr<const Queries> make_queries(const Size& size, float radius) {
  const auto made = std::make_shared<Queries>();
  made->map = photon::PhotonMap::build(wall_photons(size.mapped));
  for (const photon::Photon& point : tile_points(size.tiles_per_axis)) {
    made->queries.push_back({point.p, point.n, point.surface_group, radius, photon::kAllPhotons});
  }
  return made;
}

// kReach: photons within the radius. With 50 the walk of the tree and the loop over photons take about the
// same time; with 500 the loop dominates.
template <uint32_t kReach>
Kernel gather_kernel(const Size& size) {
  const auto made = make_queries(size, radius_for(kReach, size.mapped));
  return {[made] {
    photon::GatherCounters counters;
    for (const photon::GatherQuery& query : made->queries) {
      benchmark::DoNotOptimize(photon::gather_flux(made->map, query, {}, counters));
    }
  }};
}

// The search begins with four times the final radius.
template <uint32_t kNearest>
Kernel nearest_kernel(const Size& size) {
  const auto made = make_queries(size, 4 * radius_for(kNearest, size.mapped));
  return {[made] {
    photon::GatherCounters counters;
    for (const photon::GatherQuery& query : made->queries) {
      benchmark::DoNotOptimize(photon::nearest_radius(made->map, query, kNearest, counters));
    }
  }};
}

struct KernelEntry {
  std::string_view name;
  Kernel (*make)(const Size&);
};
constexpr KernelEntry kKernels[] = {{"shoot", shoot_kernel},
                                    {"build", build_kernel},
                                    {"gather-50", gather_kernel<50>},
                                    {"gather-500", gather_kernel<500>},
                                    {"nearest-50", nearest_kernel<50>}};

int run_once(std::string_view name) {
  for (const KernelEntry& entry : kKernels) {
    if (entry.name != name) continue;
    const Kernel kernel = entry.make(kCounted);
    kernel.prepare();
    counted_work(kernel.work);
    return 0;
  }
  std::fprintf(stderr, "perf_kernels: no kernel of this name\n");
  return 2;
}

// Google Benchmark calls this several times, until it has settled the number of iterations.
void time_kernel(benchmark::State& state, const Kernel& kernel) {
  for (auto _ : state) {
    state.PauseTiming();
    kernel.prepare();
    state.ResumeTiming();
    counted_work(kernel.work);
  }
}

int run_benchmarks(int argc, char** argv) {
  for (const KernelEntry& entry : kKernels) {
    const auto run = [&entry, kernel = Kernel()](benchmark::State& state) mutable {
      if (!kernel.work) kernel = entry.make(kTimed);
      time_kernel(state, kernel);
    };
    benchmark::RegisterBenchmark(std::string(entry.name).c_str(), run)->Unit(benchmark::kMillisecond);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace
}  // namespace kaustik::benchmarks

int main(int argc, char** argv) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  if (argc == 3 && std::string_view(argv[1]) == "--once") return kaustik::benchmarks::run_once(argv[2]);
  return kaustik::benchmarks::run_benchmarks(argc, argv);
}
