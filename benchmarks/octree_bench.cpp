// Building the photon map against a radix sort of the same keys, in one run. Arguments: photons; give more
// with
//   octree_bench --benchmark_filter=/10000000
// The map's time holds everything: bounds, keys, sort, octree, and the copy of the records into columns.

#include <benchmark/benchmark.h>
#include <tbb/parallel_for.h>

#include "benchmarks/wall_photons.h"
#include "photon/photon_map.h"
#include "photon/radix_sort.h"

namespace kaustik::benchmarks {
namespace {

using photon::MortonCube;
using photon::PhotonBuffer;
using photon::PhotonMap;
using photon::UninitialisedArray;

void BM_BuildPhotonMap(benchmark::State& state) {
  const PhotonBuffer photons = wall_photons(size_t(state.range(0)));
  for (auto _ : state) {
    state.PauseTiming();
    PhotonBuffer copy = photons;
    state.ResumeTiming();
    benchmark::DoNotOptimize(PhotonMap::build(std::move(copy)));
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

struct Keys {
  UninitialisedArray<uint64_t> keys;
  UninitialisedArray<uint32_t> values;
};

Keys wall_keys(const PhotonBuffer& photons) {
  const MortonCube cube = MortonCube::around({Point3(0), Point3(kRoom)});
  Keys made{UninitialisedArray<uint64_t>(photons.records.size()),
            UninitialisedArray<uint32_t>(photons.records.size())};
  tbb::parallel_for(size_t(0), photons.records.size(), [&](size_t i) {
    const photon::PhotonRecord& r = photons.records[i];
    made.keys[i] = photon::morton_key(cube.cell({r.x, r.y, r.z}));
    made.values[i] = uint32_t(i);
  });
  return made;
}

template <class Sort>
void time_sort(benchmark::State& state, const Sort& sort) {
  const PhotonBuffer photons = wall_photons(size_t(state.range(0)));
  for (auto _ : state) {
    state.PauseTiming();
    Keys keys = wall_keys(photons);
    state.ResumeTiming();
    sort(keys);
    benchmark::DoNotOptimize(keys.keys.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void BM_OurRadixSort(benchmark::State& state) {
  time_sort(state, [](Keys& keys) { radix_sort(keys.keys, keys.values); });
}

// The rival, on its own: a parallel least-significant-digit radix sort of (key, index) pairs, 8 bits a pass.
struct Pair {
  uint64_t key;
  uint32_t value;
};

void plain_radix_pass(const std::vector<Pair>& from, std::vector<Pair>& to, int shift) {
  constexpr size_t kBlocks = 64;
  const size_t block = (from.size() + kBlocks - 1) / kBlocks;
  std::vector<std::array<size_t, 256>> counts(kBlocks);
  const auto each_block = [&](const auto& fn) {
    tbb::parallel_for(size_t(0), kBlocks, [&](size_t b) {
      for (size_t i = b * block; i < std::min(from.size(), (b + 1) * block); ++i) {
        fn(counts[b][from[i].key >> shift & 255], from[i]);
      }
    });
  };
  each_block([](size_t& count, const Pair&) { ++count; });
  size_t sum = 0;
  for (size_t d = 0; d < 256; ++d) {
    for (size_t b = 0; b < kBlocks; ++b) sum += std::exchange(counts[b][d], sum);
  }
  each_block([&](size_t& place, const Pair& pair) { to[place++] = pair; });
}

void BM_PlainRadixSort(benchmark::State& state) {
  const PhotonBuffer photons = wall_photons(size_t(state.range(0)));
  const Keys keys = wall_keys(photons);
  std::vector<Pair> from(photons.records.size()), to(photons.records.size());
  for (auto _ : state) {
    state.PauseTiming();
    for (size_t i = 0; i < from.size(); ++i) from[i] = {keys.keys[i], keys.values[i]};
    state.ResumeTiming();
    for (int shift = 0; shift < 64; shift += 8) {
      plain_radix_pass(from, to, shift);
      std::swap(from, to);
    }
    benchmark::DoNotOptimize(from.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void sizes(benchmark::internal::Benchmark* bench) {
  bench->ArgName("photons")->Unit(benchmark::kMillisecond)->UseRealTime();
  bench->Arg(1'000'000)->Arg(10'000'000);
}

BENCHMARK(BM_BuildPhotonMap)->Apply(sizes);
BENCHMARK(BM_OurRadixSort)->Apply(sizes);
BENCHMARK(BM_PlainRadixSort)->Apply(sizes);

}  // namespace
}  // namespace kaustik::benchmarks

BENCHMARK_MAIN();
