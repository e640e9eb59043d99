// Compares structures that find photons within a radius: the photon map, nanoflann's kd-tree, a spatial hash,
// the lecture's pointer octree, and as an upper limit of speed a dense grid made for the radius. All have the
// same photons, the same queries in the order of a picture's tiles, the same rule of which photons count and
// the same sum; tests/photon/map/photon_index_test.cpp tests that they agree. Arguments: photons, photons in
// reach. The benchmark "nearest" finds the radius of the k-th photon that counts, by the photon map and by
// nanoflann.
//
//   index_bench --benchmark_enable_random_interleaving=true --benchmark_repetitions=7
//     --benchmark_report_aggregates_only=true --benchmark_min_time=0.05
//
// --large adds ten million photons (5 GB, minutes). The column CPU of a build is that of all its threads;
// only the photon map has several.

#include <benchmark/benchmark.h>

#include <map>
#include <optional>

#include "benchmarks/rivals/dense_grid.h"
#include "benchmarks/rivals/hash_grid.h"
#include "benchmarks/rivals/kd_tree.h"
#include "benchmarks/rivals/photon_map_index.h"
#include "benchmarks/rivals/pointer_octree.h"
#include "benchmarks/take_flag.h"
#include "benchmarks/wall_photons.h"

namespace kaustik::benchmarks {
namespace {

struct Size {
  size_t photons;
  float radius;
  explicit Size(const benchmark::State& state)
      : photons(size_t(state.range(0))), radius(radius_for(double(state.range(1)), photons)) {}
};

template <PhotonIndex Index>
void BM_Build(benchmark::State& state) {
  const Size size(state);
  const photon::PhotonBuffer photons = wall_photons(size.photons);
  uint64_t bytes = 0;
  for (auto _ : state) {
    state.PauseTiming();
    photon::PhotonBuffer copy = photons;
    std::optional<Index> index;
    state.ResumeTiming();
    index.emplace(Index::build(std::move(copy), size.radius));
    state.PauseTiming();
    bytes = index->memory_bytes();
    index.reset();
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
  state.counters["bytes_per_photon"] = double(bytes) / double(size.photons);
}

// Built once for each size and kept, since repetitions are interleaved.
template <PhotonIndex Index>
const Index& shared_index(const Size& size) {
  static std::map<std::pair<size_t, float>, Index> indices;
  const std::pair key(size.photons, size.radius);
  auto at = indices.find(key);
  if (at == indices.end()) {
    at = indices.emplace(key, Index::build(wall_photons(size.photons), size.radius)).first;
  }
  return at->second;
}

// Calls search(index, query, counters) for each query of radius `radius`.
template <PhotonIndex Index, class Fn>
void run_queries(benchmark::State& state, const Index& index, float radius, const Fn& search) {
  static const std::vector<photon::Photon> points = tile_points(12);
  photon::GatherCounters counters;
  for (auto _ : state) {
    for (const photon::Photon& point : points) {
      const photon::GatherQuery query{point.p, point.n, point.surface_group, radius, photon::kAllPhotons};
      benchmark::DoNotOptimize(search(index, query, counters));
    }
  }
  const double queries = double(counters.queries);
  state.SetItemsProcessed(int64_t(counters.queries));
  state.counters["accepted"] = double(counters.accepted) / queries;
  state.counters["candidates"] = double(counters.candidates) / queries;
}

template <PhotonIndex Index>
void BM_Gather(benchmark::State& state) {
  const Size size(state);
  run_queries(state, shared_index<Index>(size), size.radius,
              [](const Index& index, const photon::GatherQuery& query, photon::GatherCounters& counters) {
                return index.flux_density(query, counters);
              });
}

// The search may reach four times as far as the k-th photon is expected.
template <NearestIndex Index>
void BM_Nearest(benchmark::State& state) {
  const Size size(state);
  const uint32_t k = uint32_t(state.range(1));
  run_queries(state, shared_index<Index>(size), 4 * size.radius,
              [k](const Index& index, const photon::GatherQuery& query, photon::GatherCounters& counters) {
                return index.nearest_radius(query, k, counters);
              });
}

template <PhotonIndex Index>
void add(int64_t photons) {
  const std::string name(Index::kName);
  const auto gather = benchmark::RegisterBenchmark(("gather/" + name).c_str(), BM_Gather<Index>);
  const auto build = benchmark::RegisterBenchmark(("build/" + name).c_str(), BM_Build<Index>);
  for (auto* bench : {gather, build}) bench->ArgNames({"photons", "reach"})->Unit(benchmark::kMillisecond);
  gather->Args({photons, 50})->Args({photons, 500});
  build->Args({photons, 50})->MeasureProcessCPUTime();
  if constexpr (NearestIndex<Index>) {
    const auto nearest = benchmark::RegisterBenchmark(("nearest/" + name).c_str(), BM_Nearest<Index>);
    nearest->ArgNames({"photons", "k"})->Unit(benchmark::kMillisecond);
    nearest->Args({photons, 50})->Args({photons, 500});
  }
}

template <PhotonIndex... Indices>
void add_all(int64_t photons) {
  (add<Indices>(photons), ...);
}

}  // namespace
}  // namespace kaustik::benchmarks

int main(int argc, char** argv) {
  using namespace kaustik::benchmarks;
  const bool large = take_flag(argc, argv, "--large");
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const auto add_size = add_all<PhotonMapIndex, DenseGrid, KdTree, HashGrid, PointerOctree>;
  add_size(1'000'000);
  if (large) add_size(10'000'000);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
