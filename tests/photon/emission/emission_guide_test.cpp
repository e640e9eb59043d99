// Tests guided emission: the points are drawn with the stated density, whatever was learned, and guided
// photons carry on average the flux of uniform ones.

#include "photon/emission/emission_guide.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "core/sampling/sampler.h"
#include "photon/shoot/guide_shoot.h"
#include "photon/shoot/shoot.h"
#include "tests/photon/support/trace_scenes.h"
#include "tests/support/packed_flux.h"
#include "tests/support/shapes.h"
#include "tests/support/statistics.h"

namespace kaustik::photon {
namespace {

using test::settings_for;

EmissionPoint point(uint64_t seed, uint64_t index) {
  Sampler sampler(seed, index);
  EmissionPoint u;
  for (float& x : u) x = sampler.next_1d();
  return u;
}

// Whether u lies in a narrow box of volume 0.02 x 0.05 x 0.5.
bool in_cluster(const EmissionPoint& u) {
  return u[0] > 0.3f && u[0] < 0.32f && u[2] > 0.9f && u[2] < 0.95f && u[4] < 0.5f;
}
std::vector<GuideHit> cluster(size_t count, double weight = 1) {
  std::vector<GuideHit> hits;
  for (uint64_t i = 0; i < count; ++i) {
    EmissionPoint u = point(7, i);
    u[0] = 0.3f + 0.02f * u[0], u[2] = 0.9f + 0.05f * u[2], u[4] *= 0.5f;
    hits.push_back({u, weight});
  }
  return hits;
}

// With N points of density p and weights 1/p, the mean weight in any region is its volume. A weight is at
// most 1 / kUniformShare, so the variance of the mean is at most volume / kUniformShare / N.
TEST(EmissionGuide, DrawsWithTheStatedDensity) {
  const EmissionGuide guide(cluster(4000), 5);
  constexpr uint64_t kPoints = 200'000;
  double all = 0, low = 0, inside = 0, drawn_inside = 0;
  for (uint64_t i = 0; i < kPoints; ++i) {
    EmissionPoint u = point(3, i);
    const float weight = guide.warp(u);
    for (const float x : u) ASSERT_TRUE(x >= 0 && x < 1) << x;
    ASSERT_LE(weight, 1.0001 / EmissionGuide::kUniformShare);
    // At the face of a box, rounding may take a point to the next box.
    if (guide.density(u) * weight < 0.999f || guide.density(u) * weight > 1.001f) continue;
    all += weight;
    low += u[1] < 0.25f ? weight : 0;
    inside += in_cluster(u) ? weight : 0;
    drawn_inside += in_cluster(u);
  }
  const auto bound = [&](double volume) {
    return 4 * std::sqrt(volume / EmissionGuide::kUniformShare / double(kPoints));
  };
  EXPECT_NEAR(all / kPoints, 1, bound(1));
  EXPECT_NEAR(low / kPoints, 0.25, bound(0.25));
  EXPECT_NEAR(inside / kPoints, 0.02 * 0.05 * 0.5, bound(0.02 * 0.05 * 0.5));
  EXPECT_GT(drawn_inside / kPoints, (1 - EmissionGuide::kUniformShare) / 3);  // in a volume of 0.0005
  EXPECT_LT(guide.variance(), 0.02);
}

TEST(EmissionGuide, DependsOnRatiosOfWeightsOnly) {
  const EmissionGuide a(cluster(1000), 5), b(cluster(1000, 0x1p-60), 5), c(cluster(1000, 0x1p90), 5);
  for (uint64_t i = 0; i < 1000; ++i) {
    const EmissionPoint at = point(1, i);
    EmissionPoint u = at, v = at, w = at;
    const float weight = a.warp(u);
    EXPECT_EQ(b.warp(v), weight);
    EXPECT_EQ(c.warp(w), weight);
    EXPECT_EQ(u, v);
  }
}

// Hits that are spread evenly, or too few to be significant, teach nothing.
TEST(EmissionGuide, LearnsNothingFromEvenHits) {
  std::vector<GuideHit> even;
  for (uint64_t i = 0; i < 4096; ++i) even.push_back({point(5, i), 1});
  for (const EmissionGuide& guide : {EmissionGuide(even, 5), EmissionGuide(cluster(3), 5)}) {
    EXPECT_FALSE(guide.empty());
    EXPECT_GT(guide.variance(), 0.9);
  }
  EXPECT_TRUE(EmissionGuide({}, 5).empty());
}

LearnedGuide learn(const Scene& scene, int threads = 2, uint64_t photons = 100'000) {
  const tbb::global_control cap(tbb::global_control::max_allowed_parallelism, size_t(threads));
  const accel::Bvh bvh(scene, threads);
  LearnedGuide learned;
  tbb::task_arena(threads).execute(
      [&] { learned = learn_guide(scene, bvh, {.seed = 4, .photons = photons}); });
  return learned;
}

// A room with a small glass sphere below the light, with a radius of `size` times the room's half width.
Scene room_with_marble(float size, float s = 1) {
  Scene scene = test::lit_room(Rgb(0.5f), Rgb(4, 2, 1), s);
  scene.materials.push_back(Dielectric{1.5f});
  scene.shapes.push_back(test::sphere({0.2f * s, -0.8f * s, 0.1f * s}, size * s, 1));
  finalize_scene(scene);
  return scene;
}

ShootResult shoot_caustics(const Scene& scene, uint64_t photons, const EmissionGuide* guide, uint64_t seed) {
  TraceSettings settings = settings_for(photons, {false, false, true, false});
  settings.seed = seed;
  settings.guide = guide;
  return shoot(scene, accel::Bvh(scene), settings);
}

double flux_of(const ShootResult& shot) {
  const PhotonBuffer& buffer = shot.buffers[size_t(PhotonKind::kCaustic)];
  double sum = 0;
  for (const PhotonRecord& record : buffer.records) {
    const Photon photon = unpack(record, buffer.flux_unit);
    sum += double(photon.flux.x) + double(photon.flux.y) + double(photon.flux.z);
  }
  return sum;
}

test::Estimate flux_over_seeds(const Scene& scene, const EmissionGuide* guide) {
  test::Mean flux;
  for (uint64_t seed = 0; seed < 12; ++seed) flux.add(flux_of(shoot_caustics(scene, 20'000, guide, seed)));
  return flux.estimate();
}

// The tolerance is 5 standard errors with 22 degrees of freedom, plus the rounding of packed fluxes.
void expect_equal_flux(const test::Estimate& a, const test::Estimate& b) {
  EXPECT_NEAR(a.mean, b.mean,
              5 * std::hypot(a.standard_error, b.standard_error) + test::kPackedFluxError * a.mean);
}

TEST(GuidedEmission, CarriesTheFluxOfUniformEmission) {
  const Scene scene = test::full_room();
  const LearnedGuide learned = learn(scene);
  ASSERT_FALSE(learned.guide.empty());
  const test::Estimate uniform = flux_over_seeds(scene, nullptr),
                       guided = flux_over_seeds(scene, &learned.guide);
  expect_equal_flux(uniform, guided);
  EXPECT_LT(guided.standard_error, 0.1 * guided.mean);  // the test can fail
}

// The marble is met by one photon in 1100.
TEST(GuidedEmission, FindsASmallTarget) {
  const Scene scene = room_with_marble(0.05f);
  const LearnedGuide learned = learn(scene, 2, 1'000'000);
  const uint64_t uniform = shoot_caustics(scene, 100'000, nullptr, 1).counters.stored[2],
                 guided = shoot_caustics(scene, 100'000, &learned.guide, 1).counters.stored[2];
  EXPECT_GT(guided, 20 * uniform);
  EXPECT_LT(learned.guide.variance(), 0.1);
  expect_equal_flux(flux_over_seeds(scene, nullptr), flux_over_seeds(scene, &learned.guide));
}

TEST(GuidedEmission, LightsWithoutLearnedHitsKeepTheirFlux) {
  Scene scene = room_with_marble(0.3f);
  test::add_light(scene, test::parallelogram({-0.9f, 0.5f, -0.9f}, {0.1f, 0, 0}, {0, 0, 0.1f}), Rgb(40));
  finalize_scene(scene);
  ASSERT_EQ(scene.lights.size(), 2u);
  std::vector<GuideHit> hits;
  for (uint64_t i = 0; i < 2000; ++i) {
    hits.push_back({point(2, i), 1});
    hits.back().u[4] *= scene.light_power.pdf(0);
  }
  const EmissionGuide guide(hits, 5);
  const test::Estimate uniform = flux_over_seeds(scene, nullptr), guided = flux_over_seeds(scene, &guide);
  expect_equal_flux(uniform, guided);
  EXPECT_LT(5 * std::hypot(uniform.standard_error, guided.standard_error), 0.2 * uniform.mean);
}

TEST(GuidedEmission, IsOffWhereNoPhotonOrEveryPhotonHits) {
  EXPECT_TRUE(learn(test::lit_room(Rgb(0.5f), Rgb(1))).guide.empty());
  Scene dark = test::full_room();
  dark.lights.clear();
  for (Shape& shape : dark.shapes) shape.light = kNoIndex;
  finalize_scene(dark);
  EXPECT_TRUE(learn(dark).guide.empty());
  EXPECT_EQ(learn(test::lit_room(Rgb(0.5f), Rgb(1))).hits, 0u);
  // A glass plate below the light, as wide as the room: every photon meets it.
  Scene covered = test::lit_room(Rgb(0.5f), Rgb(1));
  covered.materials.push_back(Dielectric{1.5f});
  covered.shapes.push_back(test::parallelogram({-1, 0.5f, -1}, {2, 0, 0}, {0, 0, 2}, 1));
  finalize_scene(covered);
  const LearnedGuide learned = learn(covered);
  EXPECT_TRUE(learned.guide.empty());
  EXPECT_GT(learned.hits, learned.emitted / 2);
}

TEST(GuidedEmission, DoesNotDependOnThreadsOrScale) {
  const auto records = [](const Scene& scene, int threads) {
    const LearnedGuide learned = learn(scene, threads);
    return shoot_caustics(scene, 20'000, &learned.guide, 1).buffers[size_t(PhotonKind::kCaustic)];
  };
  const PhotonBuffer one = records(test::full_room(), 1);
  ASSERT_GT(one.records.size(), 1000u);
  for (const float scale : {1.0f, 0x1p-20f, 0x1p13f}) {
    const PhotonBuffer other = records(test::full_room(scale), 3);
    EXPECT_EQ(other.flux_unit, one.flux_unit * scale * scale);
    ASSERT_EQ(other.records.size(), one.records.size());
    for (size_t i = 0; i < one.records.size(); ++i) {
      ASSERT_EQ(other.records[i].x, one.records[i].x * scale);
      ASSERT_EQ(other.records[i].power, one.records[i].power);
      ASSERT_EQ(other.records[i].direction, one.records[i].direction);
    }
  }
}

// The path of a photon depends on its index only, not on the photons traced with it.
TEST(GuidedEmission, PhotonsDependOnTheirIndexOnly) {
  const Scene scene = test::full_room();
  const accel::Bvh bvh(scene);
  const LearnedGuide learned = learn(scene);
  TraceSettings settings = settings_for(500, {false, false, true, false});
  settings.guide = &learned.guide;
  TraceCounters ignored;
  std::vector<std::pair<uint64_t, Photon>> together;
  trace_photons(
      scene, bvh, settings, 0, settings.photons,
      [&](PhotonKind, const Photon& photon, uint64_t index) { together.emplace_back(index, photon); },
      ignored);
  ASSERT_GT(together.size(), 50u);
  for (const auto& [index, photon] : together) {
    bool found = false;
    trace_photon(
        scene, bvh, settings, index,
        [&, &p = photon](PhotonKind, const Photon& alone) { found |= alone.p == p.p; }, ignored);
    EXPECT_TRUE(found) << index;
  }
}

}  // namespace
}  // namespace kaustik::photon
