// Measures the build of the photon map from unsorted records against the upper limit of its speed, a radix
// sort of the same keys alone, and against alternatives: nanoflann's kd-tree and the lecture's octree, to
// which photons are added one by one. Arguments: photons, threads. Compare within one run, e.g.
//   octree_bench --benchmark_filter=/photons:10000000/ --benchmark_enable_random_interleaving=true
//     --benchmark_repetitions=7 --benchmark_min_time=0.01 --benchmark_report_aggregates_only=true
// The map's time includes everything: bounds, keys, sort, octree, the move of the records into columns, and
// the system's work for fresh memory, which the sort does not need. The column CPU is that of all threads.
//   --reuse-memory  keeps memory in the program from one repetition to the next: the system's work is not
//                   measured, nor is the peak
//   --100M          maps and sorts of 100 M photons only, in 6 GB

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <nanoflann.hpp>
#include <optional>

#include "apps/machine/peak_memory.h"
#include "benchmarks/kept_memory.h"
#include "benchmarks/rivals/kd_tree.h"
#include "benchmarks/rivals/lsd_radix_sort.h"
#include "benchmarks/rivals/pointer_octree.h"
#include "benchmarks/take_flag.h"
#include "benchmarks/wall_photons.h"
#include "photon/map/photon_map.h"
#include "render/statistics_json.h"

namespace kaustik::benchmarks {
namespace {

using photon::MortonCube;
using photon::PhotonBuffer;
using photon::PhotonMap;

// Limits the threads of a benchmark to its last argument.
class ThreadLimit {
 public:
  explicit ThreadLimit(const benchmark::State& state)
      : limit_(tbb::global_control::max_allowed_parallelism, size_t(state.range(1))) {}

 private:
  tbb::global_control limit_;
};

// peak_per_photon: bytes at the peak of the build, including the records.
void BM_BuildPhotonMap(benchmark::State& state, bool with_peak) {
  const ThreadLimit limit(state);
  const double photons = double(state.range(0));
  double stored = 0, peak = 0;
  for (auto _ : state) {
    state.PauseTiming();
    if (with_peak) app::restart_peak_memory();
    const double before = double(render::peak_memory_bytes());
    PhotonBuffer buffer = wall_photons(size_t(state.range(0)));
    std::optional<PhotonMap> map;
    state.ResumeTiming();
    map.emplace(PhotonMap::build(std::move(buffer)));
    state.PauseTiming();
    stored = double(map->memory_bytes());
    peak = std::max(peak, double(render::peak_memory_bytes()) - before);
    map.reset();
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
  state.counters["bytes_per_photon"] = stored / photons;
  if (with_peak) state.counters["peak_per_photon"] = peak / photons;
}

template <int kBits>
void BM_LsdRadixSort(benchmark::State& state) {
  const ThreadLimit limit(state);
  const PhotonBuffer photons = wall_photons(size_t(state.range(0)));
  const MortonCube cube = MortonCube::around({Point3(0), Point3(kRoom)});
  KeyIndices pairs = make_key_indices(photons.records.size()), spare = make_key_indices(pairs.size());
  fill_key_indices(photons.records, cube, spare);
  for (auto _ : state) {
    state.PauseTiming();
    fill_key_indices(photons.records, cube, pairs);
    state.ResumeTiming();
    lsd_radix_sort<kBits>(pairs, spare);
    benchmark::DoNotOptimize(pairs.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

// nanoflann with its defaults: the records in the order of the shoot, the default leaf size. Serial.
struct RecordCloud {
  const photon::PhotonRecords& records;
  size_t kdtree_get_point_count() const { return records.size(); }
  float kdtree_get_pt(size_t i, size_t axis) const { return (&records[i].x)[axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

void BM_BuildNanoflann(benchmark::State& state) {
  using Index =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, RecordCloud>, RecordCloud, 3>;
  const PhotonBuffer photons = wall_photons(size_t(state.range(0)));
  const RecordCloud cloud{photons.records};
  for (auto _ : state) {
    std::optional<Index> index(std::in_place, 3, cloud);
    benchmark::DoNotOptimize(index->size(*index));
    state.PauseTiming();
    index.reset();
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

// Builds an index as index_bench does: nanoflann gets the photons in Morton order, by a radix sort, and
// larger leaves. The time to free it does not count.
template <PhotonIndex Index>
void BM_BuildRival(benchmark::State& state) {
  const PhotonBuffer photons = wall_photons(size_t(state.range(0)));
  for (auto _ : state) {
    state.PauseTiming();
    PhotonBuffer copy = photons;
    std::optional<Index> index;
    state.ResumeTiming();
    index.emplace(Index::build(std::move(copy), 0));
    state.PauseTiming();
    index.reset();
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

using Sizes = std::vector<int64_t>;

template <class Fn>
void add(const std::string& name, const Fn& fn, const Sizes& sizes, const Sizes& threads) {
  const auto bench = benchmark::RegisterBenchmark(name.c_str(), fn);
  bench->ArgNames({"photons", "threads"})->ArgsProduct({sizes, threads});
  bench->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
}

void add_all(bool large, bool reuse) {
  const Sizes few{1'000'000, 10'000'000}, many{100'000'000}, &sizes = large ? many : few;
  add("map", [reuse](benchmark::State& state) { BM_BuildPhotonMap(state, !reuse); }, sizes, {1, 2});
  add("lsd_radix_sort_11", BM_LsdRadixSort<11>, sizes, {1, 2});
  add("lsd_radix_sort_8", BM_LsdRadixSort<8>, sizes, {1, 2});
  if (large) return;
  add("nanoflann", BM_BuildNanoflann, sizes, {1});
  add("nanoflann_sorted_first", BM_BuildRival<KdTree>, sizes, {1});
  add("pointer_octree", BM_BuildRival<PointerOctree>, sizes, {1});
}

}  // namespace
}  // namespace kaustik::benchmarks

int main(int argc, char** argv) {
  using namespace kaustik::benchmarks;
  const bool large = take_flag(argc, argv, "--100M"), reuse = take_flag(argc, argv, "--reuse-memory");
  if (reuse) keep_large_blocks();
  add_all(large, reuse);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
