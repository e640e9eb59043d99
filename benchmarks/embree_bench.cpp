// Measures bare Embree, the upper limit of speed for every ray ("roof"), and the renderer's own calls against
// it.
//
//   roof/<call>/<rays>/<scene>        rtcIntersect1, 8, 16 (by default and with the coherent flag) and
//                                     rtcOccluded1 on rays already in Embree's own layout: s per ray
//   end_to_end/<call>/<rays>/<scene>  accel::Bvh on the same rays as plain Rays or RayLanes, alternating with
//                                     its roof; counters roof_ns and ours_ns per ray, ratio = roof / ours,
//                                     each the median of eleven rounds, in CPU time of one thread. Packets
//                                     have two roofs, of which the faster counts.
//
// Rays: camera (tile by tile), photon (path by path, recorded from the tracer), packet (the packets that the
// tracer makes of photons), shadow (camera hits to lights). Scenes: a box of 14 triangles, cornell-spheres,
// tncg15-room, water over a floor (103 k triangles), two wavy sheets in the box (1 M); --large adds sheets of
// 10 M (2 GB, half a minute to build). Every round checks that both sides hit as many surfaces.
//
//   embree_bench --benchmark_filter=end_to_end
//   embree_bench --benchmark_filter=roof --benchmark_enable_random_interleaving=true
//     --benchmark_repetitions=5 --benchmark_min_time=0.05 --benchmark_report_aggregates_only=true

#include <benchmark/benchmark.h>

#include <functional>
#include <map>
#include <memory>

#include "accel/bvh.h"
#include "benchmarks/bare_scene.h"
#include "benchmarks/bench_scenes.h"
#include "benchmarks/cpu_time.h"
#include "benchmarks/embree_queries.h"
#include "benchmarks/ray_sets.h"
#include "benchmarks/take_flag.h"

namespace kaustik::benchmarks {
namespace {

constexpr size_t kRays = 1 << 17;
constexpr int kRounds = 11;

template <int kWidth>
struct Packet;
template <>
struct Packet<1> {
  using Rays = RTCRay;
  using Query = RTCRayHit;
};
template <>
struct Packet<8> {
  using Rays = RTCRay8;
  using Query = RTCRayHit8;
};
template <>
struct Packet<16> {
  using Rays = RTCRay16;
  using Query = RTCRayHit16;
};

template <int kWidth>
std::vector<typename Packet<kWidth>::Rays> packets(const std::vector<Ray>& rays) {
  std::vector<typename Packet<kWidth>::Rays> made(rays.size() / kWidth);
  for (size_t i = 0; i < made.size() * kWidth; ++i) {
    auto* r = reinterpret_cast<RTCRayN*>(&made[i / kWidth]);
    const unsigned lane = i % kWidth;
    RTCRayN_org_x(r, kWidth, lane) = rays[i].o.x;
    RTCRayN_org_y(r, kWidth, lane) = rays[i].o.y;
    RTCRayN_org_z(r, kWidth, lane) = rays[i].o.z;
    RTCRayN_dir_x(r, kWidth, lane) = rays[i].d.x;
    RTCRayN_dir_y(r, kWidth, lane) = rays[i].d.y;
    RTCRayN_dir_z(r, kWidth, lane) = rays[i].d.z;
    RTCRayN_tnear(r, kWidth, lane) = std::numeric_limits<float>::min();
    RTCRayN_tfar(r, kWidth, lane) = rays[i].t_max;
    RTCRayN_time(r, kWidth, lane) = 0;
    RTCRayN_mask(r, kWidth, lane) = 0xffffffffu;
    RTCRayN_id(r, kWidth, lane) = 0;
    RTCRayN_flags(r, kWidth, lane) = 0;
  }
  return made;
}

std::vector<accel::RayLanes> lanes(const std::vector<Ray>& rays) {
  std::vector<accel::RayLanes> made(rays.size() / accel::kRayLanes);
  for (size_t i = 0; i < rays.size(); ++i) {
    accel::RayLanes& to = made[i / accel::kRayLanes];
    for (int c = 0; c < 3; ++c) {
      to.o[c][i % accel::kRayLanes] = rays[i].o[c];
      to.d[c][i % accel::kRayLanes] = rays[i].d[c];
    }
  }
  return made;
}

// Rays in every layout. Their number is a multiple of the widest packet.
struct RaySet {
  std::vector<Ray> plain;
  std::vector<RTCRay> ready1;
  std::vector<RTCRay8> ready8;
  std::vector<RTCRay16> ready16;
  std::vector<accel::RayLanes> lane64;

  explicit RaySet(std::vector<Ray> rays) : plain(std::move(rays)) {
    plain.resize(plain.size() / accel::kRayLanes * accel::kRayLanes);
    ready1 = packets<1>(plain);
    ready8 = packets<8>(plain);
    ready16 = packets<16>(plain);
    lane64 = lanes(plain);
  }
};

struct Workbench {
  Scene scene;
  accel::Bvh bvh;
  BareScene bare;
  std::map<std::string, RaySet> sets;

  explicit Workbench(Scene made) : scene(std::move(made)), bvh(scene), bare(scene) {
    const std::vector<Ray> camera = camera_rays(scene);
    sets.emplace("camera", RaySet(camera));
    sets.emplace("photon", RaySet(photon_rays(scene, bvh, kRays)));
    sets.emplace("packet", RaySet(packet_rays(scene, bvh, kRays)));
    sets.emplace("shadow", RaySet(shadow_rays(scene, bvh, camera)));
  }
};

struct SceneRow {
  std::string name;
  std::function<Scene()> make;
};

std::vector<SceneRow> scene_rows(bool large) {
  std::vector<SceneRow> rows = {
      {"box", [] { return room(0); }},
      {"cornell-spheres", [] { return scene_file("cornell-spheres/square-lamp-2.pbrt"); }},
      {"tncg15-room", [] { return scene_file("tncg15-room/tncg15-room.pbrt"); }},
      {"water", water_box},
      {"sheets-1M", [] { return room(500); }}};
  if (large) rows.push_back({"sheets-10M", [] { return room(1581); }});
  return rows;
}

// Built at the first call and kept, since repetitions are interleaved.
const Workbench& workbench(const SceneRow& row) {
  static std::map<std::string, std::unique_ptr<Workbench>> made;
  auto& at = made[row.name];
  if (!at) at = std::make_unique<Workbench>(row.make());
  return *at;
}

// Each function returns how many rays hit something.

template <int kWidth>
uint64_t bare_intersect(const BareScene& bare, const std::vector<typename Packet<kWidth>::Rays>& rays,
                        bool coherent) {
  EmbreeQueries embree(bare.scene(), coherent);
  alignas(64) int valid[kWidth];
  std::fill_n(valid, kWidth, -1);
  uint64_t hits = 0;
  for (const auto& ready : rays) {
    typename Packet<kWidth>::Query query;
    query.ray = ready;
    auto* hit = RTCRayHitN_HitN(reinterpret_cast<RTCRayHitN*>(&query), kWidth);
    for (unsigned i = 0; i < kWidth; ++i) {
      RTCHitN_geomID(hit, kWidth, i) = RTC_INVALID_GEOMETRY_ID;
      RTCHitN_instID(hit, kWidth, i, 0) = RTC_INVALID_GEOMETRY_ID;
    }
    embree.intersect(valid, &query);
    for (unsigned i = 0; i < kWidth; ++i) hits += RTCHitN_geomID(hit, kWidth, i) != RTC_INVALID_GEOMETRY_ID;
  }
  return hits;
}

uint64_t bare_occluded(const BareScene& bare, const std::vector<RTCRay>& rays) {
  EmbreeQueries embree(bare.scene(), false);
  uint64_t hits = 0;
  for (const RTCRay& ready : rays) {
    RTCRay query = ready;
    embree.occluded(&query);
    hits += query.tfar == accel::kEmbreeOccluded;
  }
  return hits;
}

uint64_t our_intersect(const accel::Bvh& bvh, const std::vector<Ray>& rays) {
  uint64_t hits = 0;
  for (const Ray& ray : rays) {
    Hit hit = bvh.intersect(ray);
    benchmark::DoNotOptimize(hit);
    hits += hit.valid();
  }
  return hits;
}

uint64_t our_intersect(const accel::Bvh& bvh, const std::vector<accel::RayLanes>& rays,
                       accel::RayOrder order) {
  uint64_t hits = 0;
  accel::HitLanes met;
  for (const accel::RayLanes& some : rays) {
    bvh.intersect(some, accel::kRayLanes, &met, order);
    for (size_t k = 0; k < accel::kRayLanes; ++k) hits += met.valid(k);
  }
  return hits;
}

uint64_t our_occluded(const accel::Bvh& bvh, const std::vector<Ray>& rays) {
  uint64_t hits = 0;
  for (const Ray& ray : rays) hits += bvh.occluded(ray);
  return hits;
}

using Pass = std::function<uint64_t(const Workbench&, const RaySet&)>;

void time_roof(benchmark::State& state, const SceneRow& row, const std::string& rays, const Pass& pass) {
  const Workbench& bench = workbench(row);
  const RaySet& set = bench.sets.at(rays);
  uint64_t hits = 0;
  for (auto _ : state) hits = pass(bench, set);
  state.SetItemsProcessed(state.iterations() * int64_t(set.plain.size()));
  state.counters["per_ray"] = benchmark::Counter(
      double(set.plain.size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["hit"] = double(hits) / double(set.plain.size());
}

void time_against_roof(benchmark::State& state, const SceneRow& row, const std::string& rays,
                       const Pass& roof, const Pass& ours) {
  const Workbench& bench = workbench(row);
  const RaySet& set = bench.sets.at(rays);
  const double to_ns = 1e9 / double(set.plain.size());
  uint64_t roof_hits = roof(bench, set), our_hits = ours(bench, set);
  std::vector<double> roofs, own, ratios;
  for (auto _ : state) {
    const auto time_roof = [&] {
      roofs.push_back(to_ns * cpu_seconds([&] { roof_hits = roof(bench, set); }));
    };
    const bool roof_first = roofs.size() % 2 == 0;
    if (roof_first) time_roof();
    own.push_back(to_ns * cpu_seconds([&] { our_hits = ours(bench, set); }));
    if (!roof_first) time_roof();
    ratios.push_back(roofs.back() / own.back());
    state.SetIterationTime(own.back() / to_ns);
  }
  // Rays along an edge may fall on either side, since the two BVHs are scaled differently.
  const double difference = std::abs(double(roof_hits) - double(our_hits));
  if (difference > 1e-4 * double(set.plain.size())) state.SkipWithError("the roof meets other surfaces");
  state.counters["roof_ns"] = median(roofs);
  state.counters["ours_ns"] = median(own);
  state.counters["ratio"] = median(ratios);
}

void add_roof(const SceneRow& row, const std::string& call, const std::string& rays, const Pass& pass) {
  const std::string name = "roof/" + call + "/" + rays + "/" + row.name;
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& s) {
    time_roof(s, row, rays, pass);
  })->Unit(benchmark::kMillisecond);
}

void add_end_to_end(const SceneRow& row, const std::string& call, const std::string& rays, const Pass& roof,
                    const Pass& ours) {
  const std::string name = "end_to_end/" + call + "/" + rays + "/" + row.name;
  benchmark::RegisterBenchmark(name.c_str(),
                               [=](benchmark::State& s) { time_against_roof(s, row, rays, roof, ours); })
      ->Unit(benchmark::kMillisecond)
      ->UseManualTime()
      ->Iterations(kRounds);
}

template <int kWidth>
Pass intersect_pass(std::vector<typename Packet<kWidth>::Rays> RaySet::*rays, bool coherent) {
  return
      [=](const Workbench& b, const RaySet& s) { return bare_intersect<kWidth>(b.bare, s.*rays, coherent); };
}

uint64_t bare_occluded_pass(const Workbench& b, const RaySet& s) {
  return bare_occluded(b.bare, s.ready1);
}

void add_roofs(const SceneRow& row) {
  for (const std::string rays : {"camera", "photon", "packet"}) {
    for (const bool coherent : {false, true}) {
      const std::string flag = coherent ? "-coherent" : "";
      add_roof(row, "rtcIntersect1" + flag, rays, intersect_pass<1>(&RaySet::ready1, coherent));
      add_roof(row, "rtcIntersect8" + flag, rays, intersect_pass<8>(&RaySet::ready8, coherent));
      add_roof(row, "rtcIntersect16" + flag, rays, intersect_pass<16>(&RaySet::ready16, coherent));
    }
  }
  for (const std::string rays : {"camera", "photon", "shadow"}) {
    add_roof(row, "rtcOccluded1", rays, bare_occluded_pass);
  }
}

void add_ours(const SceneRow& row) {
  const Pass one = [](const Workbench& b, const RaySet& s) { return our_intersect(b.bvh, s.plain); };
  const auto many = [](accel::RayOrder order) -> Pass {
    return [=](const Workbench& b, const RaySet& s) { return our_intersect(b.bvh, s.lane64, order); };
  };
  const Pass occluded = [](const Workbench& b, const RaySet& s) { return our_occluded(b.bvh, s.plain); };
  for (const std::string rays : {"camera", "photon"}) {
    add_end_to_end(row, "intersect", rays, intersect_pass<1>(&RaySet::ready1, false), one);
  }
  for (const std::string rays : {"camera", "packet"}) {
    const Pass ours = many(rays == "camera" ? accel::RayOrder::kNeighbours : accel::RayOrder::kMixed);
    add_end_to_end(row, "lanes", rays, intersect_pass<16>(&RaySet::ready16, false), ours);
    add_end_to_end(row, "lanes-coherent", rays, intersect_pass<16>(&RaySet::ready16, true), ours);
  }
  add_end_to_end(row, "occluded", "shadow", bare_occluded_pass, occluded);
}

}  // namespace
}  // namespace kaustik::benchmarks

int main(int argc, char** argv) {
  using namespace kaustik::benchmarks;
  const bool large = take_flag(argc, argv, "--large");
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  for (const SceneRow& row : scene_rows(large)) {
    add_roofs(row);
    add_ours(row);
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
