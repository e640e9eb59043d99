// Tests passes that are split, joined and extended, and radii that shrink.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "render/maps/pass_photons.h"
#include "render/maps/radius.h"
#include "render/statistics_json.h"
#include "tests/render/support/closed_forms.h"
#include "tests/render/support/image_statistics.h"
#include "tests/support/packed_flux.h"

namespace kaustik::render {
namespace {

using namespace test;

RenderSettings split_settings() {
  RenderSettings settings;
  settings.photons = 30'000;
  settings.spp = 6;
  settings.passes = 6;
  settings.alpha = 0.7f;
  return settings;
}

PassSums sums_of(const Scene& scene, const RenderSettings& settings, RenderTask task, int threads = 2) {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, size_t(threads));
  const accel::Bvh bvh(scene, threads);
  PassSums sums;
  tbb::task_arena(threads).execute([&] { sums = render(scene, bvh, settings, {}, std::move(task)).sums; });
  return sums;
}

void expect_same(const PassSums& a, const PassSums& b) {
  EXPECT_EQ(a.passes, b.passes);
  EXPECT_EQ(a.radii, b.radii);
  EXPECT_EQ(counters_json(a.statistics), counters_json(b.statistics));
  for (int y = 0; y < a.totals.pixels().height(); ++y)
    for (int x = 0; x < a.totals.pixels().width(); ++x)
      ASSERT_EQ(a.totals.pixels().at(x, y), b.totals.pixels().at(x, y)) << x << " " << y;
}

// The radii are chosen automatically, so parts without the first pass must shoot its photons for them.
TEST(Progressive, AnySplitGivesTheSameBits) {
  const Scene scene = cornell(20);
  for (const Method method : {Method::kAuto, Method::kHybrid, Method::kMc}) {
    RenderSettings settings = split_settings();
    settings.method = method;
    const PassSums whole = sums_of(scene, settings, {}, 3);
    EXPECT_EQ(whole.passes, PassSet(0, 6));
    std::vector<PassSums> parts = {sums_of(scene, settings, {.passes = PassSet(0, 2)}, 1),
                                   sums_of(scene, settings, {.passes = PassSet(2, 5)}, 2),
                                   sums_of(scene, settings, {.passes = PassSet(5, 6)}, 3)};
    std::vector<int> order = {0, 1, 2};
    do {
      PassSums merged = parts[size_t(order[0])];
      merged.add(parts[size_t(order[1])]);
      merged.add(parts[size_t(order[2])]);
      expect_same(merged, whole);
    } while (std::next_permutation(order.begin(), order.end()));
  }
}

// The sums have a gap in the middle, and the new passes go beyond those of the settings.
TEST(Progressive, ContinuesFromExistingSums) {
  const Scene scene = cornell(20);
  const RenderSettings settings = split_settings();
  const PassSums whole = sums_of(scene, settings, {.passes = PassSet(0, 8)});
  PassSums ends = sums_of(scene, settings, {.passes = PassSet(0, 2)});
  ends.add(sums_of(scene, settings, {.passes = PassSet(4, 5)}));
  std::vector<std::string> seen;
  RenderTask task{.passes = PassSet(0, 8), .done = ends, .after_pass = [&](const PassSums& sums) {
                    seen.push_back(sums.passes.text());
                    return true;
                  }};
  expect_same(sums_of(scene, settings, task), whole);
  EXPECT_EQ(seen, (std::vector<std::string>{"0:3,4:5", "0:5", "0:6", "0:7", "0:8"}));
}

// A callback may end the render after a pass; the render is then complete.
TEST(Progressive, StopsWhenTheCallbackSaysSo) {
  const Scene scene = cornell(20);
  const RenderSettings settings = split_settings();
  const RenderTask task{.passes = PassSet(0, kMostPasses),
                        .after_pass = [](const PassSums& sums) { return sums.passes.count() < 3; }};
  expect_same(sums_of(scene, settings, task), sums_of(scene, settings, {.passes = PassSet(0, 3)}));
}

// The units scale with the scene, so the multiples stay the same, for depth and point lights too.
TEST(Progressive, ScaledSceneHasTheSameMultiples) {
  const auto sums = [](float scale) {
    Scene scene = cornell(12, scale);
    scene.lights.push_back(PointLight{{0.3f * scale, 1.5f * scale, 0}, Rgb(0.7f * scale * scale)});
    finalize_scene(scene);
    RenderSettings settings = split_settings();
    settings.method = Method::kHybrid;
    settings.passes = 2;
    return sums_of(scene, settings, {});
  };
  const PassSums one = sums(1);
  for (const float scale : {0x1p-20f, 0x1p13f}) {
    const PassSums scaled = sums(scale);
    EXPECT_EQ(scaled.totals.units().radiance, one.totals.units().radiance);
    EXPECT_EQ(scaled.totals.units().depth, one.totals.units().depth + std::ilogb(scale));
    for (int y = 0; y < 12; ++y)
      for (int x = 0; x < 12; ++x)
        ASSERT_EQ(scaled.totals.pixels().at(x, y), one.totals.pixels().at(x, y)) << scale;
  }
}

// The picture is the same without the totals.
TEST(Progressive, SinglePassNeedsNoTotals) {
  const Scene scene = cornell(20);
  RenderSettings settings = split_settings();
  settings.passes = 1;
  const accel::Bvh bvh(scene);
  const RenderResult kept = render(scene, bvh, settings),
                     not_kept = render(scene, bvh, settings, {}, {.keep_sums = false});
  EXPECT_EQ(not_kept.sums.totals.pixels().width(), 0);
  EXPECT_EQ(not_kept.shown, Shown::kPasses);
  EXPECT_EQ(counters_json(kept.statistics), counters_json(not_kept.statistics));
  EXPECT_EQ(std::memcmp(&kept.film.at(0, 0), &not_kept.film.at(0, 0), sizeof(PixelResult) * 20 * 20), 0);
  settings.passes = 2;
  EXPECT_EQ(render(scene, bvh, settings, {}, {.keep_sums = false}).sums.totals.pixels().width(), 20);
}

TEST(Progressive, RefusesToJoinSumsThatShareAPass) {
  const Scene scene = cornell(8);
  RenderSettings settings = split_settings();
  PassSums a = sums_of(scene, settings, {.passes = PassSet(0, 2)});
  const PassSums b = sums_of(scene, settings, {.passes = PassSet(1, 3)});
  EXPECT_THROW(a.add(b), std::invalid_argument);
  settings.passes = 3;
  PassSums other = sums_of(scene, settings, {.passes = PassSet(2, 3)});
  EXPECT_THROW(a.add(other), std::invalid_argument);
  settings.passes = 0;
  EXPECT_THROW(sums_of(scene, settings, {.passes = PassSet(0, 2)}), std::invalid_argument);
}

TEST(PassSets, StoreRangesOfPasses) {
  PassSet set(0, 16);
  set.add(PassSet(32, 48));
  EXPECT_EQ(set.text(), "0:16,32:48");
  EXPECT_EQ(PassSet::parse("32:48,0:8,8:16"), set);
  EXPECT_EQ(set.count(), 32u);
  EXPECT_EQ(PassSet(0, 48).without(set).text(), "16:32");
  EXPECT_EQ(PassSet(10, 40).common(set).text(), "10:16,32:40");
  set.add(PassSet(10, 40));
  EXPECT_EQ(set, PassSet(0, 48));
  EXPECT_EQ(PassSet().text(), "none");
  EXPECT_TRUE(PassSet(3, 3).empty());
  for (const char* bad : {"", "5", "5:", ":5", "5:5", "6:5", "0:4,3:5", "0:4,", "-1:4", "0:4 ", "0:1e3",
                          "a:b", "0:2147483648", "0:99999999999999999999"})
    EXPECT_FALSE(PassSet::parse(bad)) << bad;
  EXPECT_TRUE(PassSet::parse("0:2147483647"));
  // A file may hold a long text, which takes no minutes.
  std::string many;
  for (int i = 0; i < 100000; ++i) many += fmt::format("{}{}:{}", i == 0 ? "" : ",", 2 * i, 2 * i + 1);
  EXPECT_EQ(PassSet::parse(many)->count(), 100000u);
}

// A point light at height 1 over a plane, seen below the light. The estimate of radius r is the mean of E = I
// h / (rho^2 + h^2)^(3/2) over the disc of radius r: 2 I h / r^2 (1 / h - 1 / sqrt(r^2 + h^2)), so with r =
// 0.5 it is 16 % too low in every pass. With alpha = 2/3 the bias is the mean over the passes' radii, and
// goes to zero.
struct ShrinkingDisc {
  double bias(float alpha, uint64_t passes) const {
    double sum = 0;
    for (uint64_t p = 0; p < passes; ++p) {
      const double r2 = kRadius * kRadius * RadiusShrink().squared(p, alpha);
      sum += 2 / r2 * (1 - 1 / std::sqrt(1 + r2));
    }
    return sum / double(passes) - 1;  // relative to E = I / h^2
  }
  // The scatter is Poisson at most: of N photons over the sphere M = N r^2 / (4 h^2) are in reach of a pass.
  double standard_error(float alpha, uint64_t passes) const {
    double sum = 0;
    for (uint64_t p = 0; p < passes; ++p)
      sum += 4 / (double(kPhotons) * kRadius * kRadius * RadiusShrink().squared(p, alpha));
    return std::sqrt(sum) / double(passes);
  }
  double measured(float alpha, uint64_t passes) const {
    Scene scene;
    const uint32_t white = add_material(scene, Lambertian{Rgb(0.5f)});
    add_shape(scene, horizontal({0, 0, 0}, 4, 4, true, white));
    look_at(scene, {2, 3, 1.5f}, {0, 0, 0}, {0, 1, 0}, 0.001f, 4, 4);
    scene.lights.push_back(PointLight{{0, 1, 0}, Rgb(3)});
    finalize_scene(scene);
    RenderSettings settings;
    settings.method = Method::kPhoton;
    settings.photons = kPhotons * passes;
    settings.passes = passes;
    settings.spp = 1;
    settings.radius = float(kRadius);
    settings.alpha = alpha;
    return total_mean(render_with_threads(scene, settings).film) * double(kPi) / (0.5 * 3) - 1;
  }
  static constexpr double kRadius = 0.5;
  static constexpr uint64_t kPhotons = 20'000;  // per pass
};

// Where the radius is that of the K-th nearest photon it shrinks because K does: in proportion to r^2, down
// to eight. The K-th photon itself does not count, so K = 1 would give no light.
TEST(Progressive, RadiiAndTheNearestPhotonsShrinkTogether) {
  const Scene scene = cornell(8);
  const accel::Bvh bvh(scene);
  for (const uint32_t nearest : {0u, 40u}) {
    RenderSettings settings;
    settings.method = Method::kPhoton;
    settings.photons = 20'000;
    settings.nearest = nearest;
    settings.alpha = 0.5f;
    const EstimatorPlan plan = make_plan(settings, scene.needs);
    PassPhotons photons;
    for (const uint64_t pass : {uint64_t{0}, uint64_t{9}, uint64_t{100'000}}) {
      RenderStatistics ignored;
      photons.make({scene, bvh, settings, plan}, pass_share(pass, 1, settings.photons, 1), {}, &ignored);
      const PhotonMaps& maps = photons.maps();
      const double squared = RadiusShrink().squared(pass, 0.5f);
      const auto k = [&](uint32_t first) { return uint32_t(std::max(8.0, std::round(first * squared))); };
      EXPECT_EQ(maps.caustic.estimate.nearest, k(nearest > 0 ? nearest : photons.radii()->caustic_nearest))
          << pass;
      EXPECT_EQ(maps.direct.estimate.nearest, k(nearest > 0 ? nearest : photons.radii()->direct_nearest))
          << pass;
      const float indirect = photons.radii()->indirect / (nearest > 0 ? kIndirectReach : 1);
      EXPECT_EQ(maps.indirect.estimate.radius, float(double(indirect) * std::sqrt(squared))) << pass;
      EXPECT_EQ(maps.lecture.radius, maps.direct.estimate.radius);
    }
  }
}

TEST(Progressive, ShrinkingRadiiRemoveTheBias) {
  const ShrinkingDisc disc;
  constexpr float kShrinking = 2.0f / 3;
  for (const float alpha : {1.0f, kShrinking}) {
    for (const uint64_t passes : {uint64_t{4}, uint64_t{64}}) {
      // All photons have the same flux, so packing may shift the mean by kPackedFluxError.
      const double bound = 4 * disc.standard_error(alpha, passes) + kPackedFluxError;
      EXPECT_NEAR(disc.measured(alpha, passes), disc.bias(alpha, passes), bound) << alpha << " " << passes;
    }
  }
  EXPECT_NEAR(disc.bias(1, 64), disc.bias(1, 4), 1e-12);
  EXPECT_LT(std::abs(disc.bias(kShrinking, 64)), 0.5 * std::abs(disc.bias(1, 64)));
  // The difference is far above the noise.
  EXPECT_GT(disc.bias(kShrinking, 64) - disc.bias(1, 64),
            8 * (disc.standard_error(kShrinking, 64) + disc.standard_error(1, 64)));
}

// Even with few photons per pass, a nearest search finds light.
TEST(Progressive, NearestPhotonsStayAtLeastEight) {
  const Scene scene = cornell(8);
  const accel::Bvh bvh(scene);
  RenderSettings settings;
  settings.method = Method::kPhoton;
  settings.photons = 40'000;
  settings.nearest = 50;
  const EstimatorPlan plan = make_plan(settings, scene.needs);
  for (const uint64_t passes : {uint64_t{34}, uint64_t{100}, uint64_t{1000}}) {
    PassPhotons photons;
    RenderStatistics ignored;
    photons.make({scene, bvh, settings, plan}, pass_share(0, passes, settings.photons, 1), {}, &ignored);
    EXPECT_EQ(photons.maps().indirect.estimate.nearest, 8u) << passes;  // 50 / 34 rounds to 1
  }
}

}  // namespace
}  // namespace kaustik::render
