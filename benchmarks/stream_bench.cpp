// Measures memory bandwidth by copy, scale, add and triad of STREAM (McCalpin 1995) with TBB threads. Bytes
// per second count only what the loops name, not the additional read of a line before it is written. The time
// is CPU time over the number of threads: on an otherwise idle machine, the wall time.
//
//   stream_bench --benchmark_repetitions=5 --benchmark_enable_random_interleaving=true
//     --benchmark_report_aggregates_only=true
//
// Argument: threads, 1 and all. Three arrays of 128 MB, four times the largest cache that is expected.

#include <benchmark/benchmark.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "benchmarks/cpu_time.h"
#include "core/memory/uninitialised_array.h"

namespace kaustik::benchmarks {
namespace {

constexpr size_t kSize = 1 << 24;

// Runs over fixed parts, one per thread, so that each thread accesses the memory that it touched first.
template <class Body>
void over_parts(int threads, const Body& body) {
  tbb::parallel_for(
      0, threads,
      [&](int part) {
        const size_t begin = kSize * size_t(part) / size_t(threads);
        const size_t end = kSize * size_t(part + 1) / size_t(threads);
        for (size_t i = begin; i < end; ++i) body(i);
      },
      tbb::static_partitioner());
}

struct Arrays {
  UninitialisedArray<double> a{kSize}, b{kSize}, c{kSize};
};

// doubles: number of doubles read and written per element. loop(arrays) returns the body.
template <class Loop>
void time_loop(benchmark::State& state, int doubles, const Loop& loop) {
  const int threads = int(state.range(0));
  tbb::task_arena arena(threads);
  arena.execute([&] {
    Arrays arrays;
    over_parts(threads, [&](size_t i) { arrays.a[i] = 1, arrays.b[i] = 2, arrays.c[i] = 0; });
    const auto body = loop(arrays);
    for (auto _ : state) {
      state.SetIterationTime(cpu_seconds([&] { over_parts(threads, body); }) / threads);
      benchmark::ClobberMemory();
    }
  });
  state.SetBytesProcessed(state.iterations() * doubles * int64_t(kSize * sizeof(double)));
}

void BM_Copy(benchmark::State& state) {
  time_loop(state, 2, [](Arrays& v) { return [a = v.a.data(), c = v.c.data()](size_t i) { c[i] = a[i]; }; });
}
void BM_Scale(benchmark::State& state) {
  time_loop(state, 2,
            [](Arrays& v) { return [b = v.b.data(), c = v.c.data()](size_t i) { b[i] = 3 * c[i]; }; });
}
void BM_Add(benchmark::State& state) {
  time_loop(state, 3, [](Arrays& v) {
    return [a = v.a.data(), b = v.b.data(), c = v.c.data()](size_t i) { c[i] = a[i] + b[i]; };
  });
}
void BM_Triad(benchmark::State& state) {
  time_loop(state, 3, [](Arrays& v) {
    return [a = v.a.data(), b = v.b.data(), c = v.c.data()](size_t i) { a[i] = b[i] + 3 * c[i]; };
  });
}

void threads(benchmark::internal::Benchmark* bench) {
  bench->ArgName("threads")->Unit(benchmark::kMillisecond)->UseManualTime()->Arg(1);
  const int all = tbb::this_task_arena::max_concurrency();
  if (all > 1) bench->Arg(all);
}

BENCHMARK(BM_Copy)->Apply(threads);
BENCHMARK(BM_Scale)->Apply(threads);
BENCHMARK(BM_Add)->Apply(threads);
BENCHMARK(BM_Triad)->Apply(threads);

}  // namespace
}  // namespace kaustik::benchmarks

BENCHMARK_MAIN();
