// Tests the parallel shoot: the same bytes for any number of threads, exact counters, progress and
// cancellation.

#include "photon/shoot/shoot.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstring>

#include "photon/trace/record_sink.h"
#include "tests/photon/support/same_records.h"
#include "tests/photon/support/trace_scenes.h"
#include "tests/support/packed_flux.h"

namespace kaustik::photon {
namespace {

using test::settings_for;

// Not a multiple of the block's size.
constexpr uint64_t kPhotons = 5 * kShootBlock + 123;

void expect_same_bytes(const ShootResult& a, const ShootResult& b) {
  for (int k = 0; k < kPhotonKinds; ++k) {
    EXPECT_TRUE(test::same_records(a.buffers[k].records, b.buffers[k].records)) << "kind " << k;
    EXPECT_EQ(a.buffers[k].flux_unit, b.buffers[k].flux_unit);
    EXPECT_EQ(a.counters.stored[k], b.counters.stored[k]);
  }
  EXPECT_EQ(a.counters.emitted, b.counters.emitted);
  EXPECT_EQ(a.counters.rays, b.counters.rays);
  EXPECT_EQ(a.counters.shadow_rays, b.counters.shadow_rays);
  EXPECT_EQ(a.counters.dropped_invalid, b.counters.dropped_invalid);
}

TEST(Shoot, SameBytesForAnyNumberOfThreads) {
  const Scene scene = test::full_room();
  const TraceSettings settings = settings_for(kPhotons, test::kAllKinds);
  std::vector<ShootResult> results;
  for (int threads : {1, 2, 3, 8}) {
    const tbb::global_control cap(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads));
    const accel::Bvh bvh(scene, threads);
    tbb::task_arena arena(threads);
    arena.execute([&] { results.push_back(shoot(scene, bvh, settings)); });
  }
  for (size_t i = 1; i < results.size(); ++i) expect_same_bytes(results[0], results[i]);
}

void sort_records(ShootResult& r) {
  for (auto& buffer : r.buffers) {
    std::sort(buffer.records.begin(), buffer.records.end(),
              [](const PhotonRecord& a, const PhotonRecord& b) { return std::memcmp(&a, &b, sizeof a) < 0; });
  }
}

// Blocks and groups change the order of the photons, but not the photons. In scenes without dispersion the
// sink does no more than pack().
void expect_the_tracers_photons(const Scene& scene) {
  const accel::Bvh bvh(scene);
  const TraceSettings settings = settings_for(kPhotons, test::kAllKinds);
  const bool plain = !scene.needs.dispersion;
  ShootResult expected;
  const float unit = flux_unit_of(scene, settings.photons);
  for (auto& buffer : expected.buffers) buffer.flux_unit = unit;
  RecordsByKind records;
  RecordSink in_xyz(unit, records, FluxColours::kXyz);
  const auto sink = [&](PhotonKind k, const Photon& p, uint64_t index) {
    plain ? records[static_cast<size_t>(k)].push_back(pack(p, unit)) : in_xyz(k, p, index);
  };
  for (uint64_t i = 0; i < settings.photons; ++i) {
    trace_photon(scene, bvh, settings, i, sink, expected.counters);
  }
  in_xyz.flush();
  for (size_t k = 0; k < records.size(); ++k) expected.buffers[k].records = std::move(records[k]);
  ShootResult got = shoot(scene, bvh, settings);
  EXPECT_EQ(got.counters.emitted, kPhotons);
  for (int k = 0; k < kPhotonKinds; ++k) {
    EXPECT_EQ(got.counters.stored[k], got.buffers[k].records.size());
    EXPECT_GT(got.buffers[k].records.size(), 0u);
  }
  sort_records(expected);
  sort_records(got);
  expect_same_bytes(expected, got);
}

TEST(Shoot, MatchesTheTracerPhotonByPhoton) {
  Scene scene = test::foggy_room();
  expect_the_tracers_photons(scene);
  scene.materials[1] = Dielectric{1.5f};
  finalize_scene(scene);
  expect_the_tracers_photons(scene);
}

// Photons of white light keep their mean in XYZ, too, although all have the same flux. Tolerance: five
// standard errors of rounding with dither, of at most a 256th of the largest number and times the sum of the
// matrix row.
TEST(Shoot, RecordsInXyzKeepTheFlux) {
  Scene scene = test::lit_room(Rgb(0.5f), Rgb(1));
  scene.materials.emplace_back(Dielectric{1.5f});
  scene.materials[1].disperse(std::make_shared<const Spectrum>(abbe_index(1.5, 20)));
  scene.shapes.push_back(test::sphere({0, -0.9f, 0}, 0.01f, 1));
  finalize_scene(scene);
  const ShootResult r = shoot(scene, accel::Bvh(scene), settings_for(kPhotons, {true, false, false, false}));
  const PhotonBuffer& direct = r.buffers[0];
  EXPECT_EQ(direct.colours, FluxColours::kXyz);
  glm::dvec3 sum(0);
  for (size_t i = 0; i < direct.records.size(); ++i) sum += glm::dvec3(direct.photon(i).flux);
  const double mean = M_PI / 4 / double(kPhotons), of_all = mean * double(direct.records.size());
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(sum[c], of_all, 5 * 4 * mean / 256 * std::sqrt(double(kPhotons))) << c;
}

// The error of each channel is bounded relative to the largest channel, which is the third.
TEST(Shoot, RecordsKeepTheFlux) {
  const Scene scene = test::lit_room(Rgb(0.5f), {1, 2, 3});
  const ShootResult r = shoot(scene, accel::Bvh(scene), settings_for(kPhotons, {true, false, false, false}));
  const PhotonBuffer& direct = r.buffers[0];
  ASSERT_EQ(direct.records.size(), kPhotons);
  glm::dvec3 sum(0);
  for (const PhotonRecord& record : direct.records) sum += glm::dvec3(unpack(record, direct.flux_unit).flux);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], M_PI / 4 * (c + 1), test::kPackedFluxError * M_PI / 4 * 3);
}

TEST(Shoot, FluxUnitIsThePowerOfTwoBelowTheMeanFlux) {
  const Scene scene = test::lit_room(Rgb(0.5f), {1, 2, 3});
  for (uint64_t n : {uint64_t{1}, uint64_t{1000}, uint64_t{10'000'000'000}}) {
    const float unit = flux_unit_of(scene, n);
    int exponent = 0;
    EXPECT_EQ(std::frexp(unit, &exponent), 0.5f);
    const double mean = M_PI / 4 * 3 / static_cast<double>(n);
    EXPECT_LE(unit, mean);
    EXPECT_GT(2 * unit, mean);
  }
  Scene dark;
  finalize_scene(dark);
  EXPECT_EQ(flux_unit_of(dark, 100), 1.0f);
}

TEST(Shoot, ScalingByPowersOfTwoKeepsTheRecords) {
  const Scene scene = test::foggy_room(), scaled = test::foggy_room(0x1p-12f);
  const TraceSettings settings = settings_for(2000, test::kAllKinds);
  const ShootResult a = shoot(scene, accel::Bvh(scene), settings),
                    b = shoot(scaled, accel::Bvh(scaled), settings);
  for (int k = 0; k < kPhotonKinds; ++k) {
    ASSERT_EQ(a.buffers[k].records.size(), b.buffers[k].records.size());
    EXPECT_EQ(a.buffers[k].flux_unit * 0x1p-24f, b.buffers[k].flux_unit);
    for (size_t i = 0; i < a.buffers[k].records.size(); ++i) {
      const PhotonRecord &p = a.buffers[k].records[i], &q = b.buffers[k].records[i];
      ASSERT_EQ(p.x * 0x1p-12f, q.x);
      ASSERT_EQ(p.y * 0x1p-12f, q.y);
      ASSERT_EQ(p.z * 0x1p-12f, q.z);
      ASSERT_EQ(p.direction, q.direction);
      ASSERT_EQ(p.power, q.power);
      ASSERT_EQ(p.surface, q.surface);
    }
  }
}

TEST(Shoot, SeedAndPassChangeThePhotons) {
  const Scene scene = test::lit_room(Rgb(0.5f), Rgb(1));
  const accel::Bvh bvh(scene);
  TraceSettings settings = settings_for(100, {true, false, false, false});
  const ShootResult first = shoot(scene, bvh, settings);
  ++settings.pass;
  const ShootResult pass = shoot(scene, bvh, settings);
  --settings.pass;
  ++settings.seed;
  const ShootResult seed = shoot(scene, bvh, settings);
  int equal = 0;
  for (size_t i = 0; i < 100; ++i) {
    equal += first.buffers[0].records[i].x == pass.buffers[0].records[i].x;
    equal += first.buffers[0].records[i].x == seed.buffers[0].records[i].x;
  }
  EXPECT_LT(equal, 100);  // walls at x = +-1 coincide by chance
}

TEST(Shoot, ReportsProgressAndStopsWhenTold) {
  const Scene scene = test::lit_room(Rgb(0.5f), Rgb(1));
  const accel::Bvh bvh(scene);
  TraceSettings settings = settings_for(kPhotons, {true, false, false, false});
  std::vector<uint64_t> done;
  shoot(scene, bvh, settings, [&](uint64_t d, uint64_t total) {
    EXPECT_EQ(total, kPhotons);
    done.push_back(d);
    return true;
  });
  ASSERT_EQ(done.size(), 6u);
  for (size_t i = 0; i < done.size(); ++i) EXPECT_EQ(done[i], std::min(kPhotons, (i + 1) * kShootBlock));

  settings.photons = 1000 * kShootBlock;
  const ShootResult stopped = shoot(scene, bvh, settings, [](uint64_t, uint64_t) { return false; });
  EXPECT_EQ(stopped.counters.emitted, kShootBlock);
  EXPECT_EQ(stopped.buffers[0].records.size(), kShootBlock);
}

TEST(Shoot, NoPhotonsOrNoKindsTraceNothing) {
  const Scene scene = test::lit_room(Rgb(0.5f), Rgb(1));
  const accel::Bvh bvh(scene);
  EXPECT_EQ(shoot(scene, bvh, settings_for(0, test::kAllKinds)).counters.emitted, 0u);
  EXPECT_EQ(shoot(scene, bvh, settings_for(1000, {})).counters.rays, 0u);
}

}  // namespace
}  // namespace kaustik::photon
