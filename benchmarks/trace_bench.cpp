// Compares photon tracing with a bare Embree walk that shades nothing.
//
// Both sides walk the same paths. The bare walk starts with the recorded first ray of each photon and
// continues from each hit, o + t d, in the recorded next direction, with rtcIntersect1 only, on its own
// Embree scene with the same flags; it keeps only a sum of distances and neither samples, shades nor stores.
// The shoot does all of its work: random numbers, emission, surface points, BSDFs, roulette, packing,
// storage, joining. As a second reference the recorded rays are also replayed with their recorded origins,
// where no ray waits for the one before. Rounds are interleaved; times are CPU time; each ratio, reference /
// shoot, is the median over the rounds. A scene of a few triangles, where Embree has little to do, is the
// worst case.
//
// Usage: trace_bench [photons = 500000] [rounds = 9] [threads = 1]

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_reduce.h>

#include <cstdio>
#include <cstdlib>
#include <functional>

#include "benchmarks/bare_scene.h"
#include "benchmarks/bench_scenes.h"
#include "benchmarks/cpu_time.h"
#include "benchmarks/photon_paths.h"
#include "photon/shoot/shoot.h"

namespace kaustik::benchmarks {
namespace {

double walk_path(const BareScene& bare, const PhotonPaths& paths, size_t first, size_t end) {
  if (first == end) return 0;
  double sum = 0;
  Ray ray = paths.rays[first];
  float near = 0;
  for (size_t i = first; i < end; ++i, near = 1e-4f) {
    ray.d = paths.rays[i].d;
    const float t = bare.distance(ray, near);
    ray.o += t * ray.d;
    sum += static_cast<double>(t);
  }
  return sum;
}

double replay_path(const BareScene& bare, const PhotonPaths& paths, size_t first, size_t end) {
  double sum = 0;
  for (size_t i = first; i < end; ++i) sum += static_cast<double>(bare.distance(paths.rays[i], 0));
  return sum;
}

template <class Path>
double over_paths(const PhotonPaths& paths, const Path& path) {
  return tbb::parallel_reduce(
      tbb::blocked_range<size_t>(0, paths.size(), 1 << 14), 0.0,
      [&](const tbb::blocked_range<size_t>& r, double sum) {
        for (size_t i = r.begin(); i < r.end(); ++i) sum += path(paths.first[i], paths.first[i + 1]);
        return sum;
      },
      std::plus<double>());
}

void compare(const char* name, const Scene& scene, photon::TraceSettings settings, int rounds) {
  const accel::Bvh bvh(scene);
  const BareScene bare(scene);
  const PhotonPaths paths = record_photon_paths(scene, bvh, settings);
  volatile double sink = 0;
  const auto walk = [&] {
    sink = over_paths(paths, [&](size_t first, size_t end) { return walk_path(bare, paths, first, end); });
  };
  const auto replay = [&] {
    sink = over_paths(paths, [&](size_t first, size_t end) { return replay_path(bare, paths, first, end); });
  };
  const auto shoot = [&] { sink = static_cast<double>(photon::shoot(scene, bvh, settings).counters.rays); };
  std::vector<double> walks, replays, shoots, walk_ratios, replay_ratios;
  for (int round = 0; round < rounds; ++round) {
    walks.push_back(cpu_seconds(walk));
    shoots.push_back(cpu_seconds(shoot));
    replays.push_back(cpu_seconds(replay));
    walk_ratios.push_back(walks.back() / shoots.back());
    replay_ratios.push_back(replays.back() / shoots.back());
  }
  const double to_ns = 1e9 / static_cast<double>(paths.rays.size());
  std::printf(
      "%-34s %9zu rays  ns/ray: walk %6.1f  replay %6.1f  shoot %6.1f   walk/shoot %.2f  replay/shoot %.2f\n",
      name, paths.rays.size(), to_ns * median(walks), to_ns * median(replays), to_ns * median(shoots),
      median(walk_ratios), median(replay_ratios));
}

}  // namespace
}  // namespace kaustik::benchmarks

int main(int argc, char** argv) {
  using namespace kaustik;
  using namespace kaustik::benchmarks;
  photon::TraceSettings settings;
  settings.photons = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 500000;
  const int rounds = argc > 2 ? std::max(5, std::atoi(argv[2])) : 9;
  const size_t threads = argc > 3 ? static_cast<size_t>(std::max(1, std::atoi(argv[3]))) : 1;
  const tbb::global_control cap(tbb::global_control::max_allowed_parallelism, threads);
  const Scene small = room(0), large = room(300);
  settings.kinds = {true, false, true, true};
  compare("box, 14 triangles", small, settings, rounds);
  for (const char* file : {"cornell-spheres/square-lamp-2.pbrt", "tncg15-room/tncg15-room.pbrt"}) {
    compare(file, scene_file(file), settings, rounds);
  }
  compare("sheets, 360k triangles", large, settings, rounds);
  settings.kinds = {true, false, false, false};
  compare("sheets, direct photons only", large, settings, rounds);
  return 0;
}
