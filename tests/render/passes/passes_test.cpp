// Tests passes: their shares of photons and samples, the same light for any number of them, the same bits for
// any number of threads.

#include "render/passes/passes.h"

#include <gtest/gtest.h>

#include <cstring>

#include "render/plan/pass_share.h"
#include "tests/render/support/class_agreement.h"

namespace kaustik::render {
namespace {

using namespace test;

TEST(Passes, AreEqualAndCoverTheRequest) {
  for (const uint64_t shares : {uint64_t{1}, uint64_t{2}, uint64_t{7}, uint64_t{64}}) {
    for (const uint64_t photons : {uint64_t{64}, uint64_t{1'000'003}, ~uint64_t{0}}) {
      for (const int spp : {1, 16, 1000}) {
        const PassShare first = pass_share(0, shares, photons, spp);
        EXPECT_EQ(first.first_sample, 0u);
        EXPECT_EQ(first.photons, (photons - 1) / shares + 1);
        EXPECT_EQ(first.end_sample, (uint64_t(spp) - 1) / shares + 1);
        uint64_t next_sample = 0;
        for (uint64_t p = 0; p < 2 * shares; ++p) {
          const PassShare pass = pass_share(p, shares, photons, spp);
          EXPECT_EQ(pass.pass, p);
          EXPECT_EQ(pass.photons, first.photons);
          EXPECT_EQ(pass.first_sample, next_sample);
          EXPECT_EQ(pass.end_sample - pass.first_sample, first.end_sample);
          next_sample = pass.end_sample;
        }
      }
    }
  }
}

// The product of (i + alpha) / (i + 1) over i = 1 ... p is Gamma(p + 1 + alpha) / (Gamma(1 + alpha) (p +
// 1)!). Each step rounds two operations and the factor, each by 2^-53; lgamma's absolute error grows with its
// value.
TEST(Passes, RadiiFollowTheClosedForm) {
  for (const float alpha : {0.1f, 0.5f, 2.0f / 3, 0.9f}) {
    EXPECT_EQ(RadiusShrink().squared(0, alpha), 1.0);
    for (const uint64_t p : {uint64_t{1}, uint64_t{2}, uint64_t{10}, uint64_t{1000}, uint64_t{100'000}}) {
      const double a = double(alpha), n = double(p);
      const double log_form = std::lgamma(n + 1 + a) - std::lgamma(1 + a) - std::lgamma(n + 2);
      const double bound = 3 * n * 0x1p-53 + 4 * std::lgamma(n + 2) * 0x1p-53;
      EXPECT_NEAR(std::log(RadiusShrink().squared(p, alpha)), log_form, bound + 1e-15) << alpha << " " << p;
    }
  }
  for (const uint64_t p : {uint64_t{0}, uint64_t{1}, uint64_t{12345}})
    EXPECT_EQ(RadiusShrink().squared(p, 1), 1.0);
}

// With a given radius the estimate is linear in the photons, so passes have the same expectation in every
// class of paths and block of pixels, and only noise differs.
TEST(Passes, GiveTheSameLight) {
  const Scene scene = cornell(kSize);
  for (const Method method : {Method::kPhoton, Method::kHybrid}) {
    RenderSettings settings = settings_of(method, 8, 0.15f, 300);
    const auto whole = films(scene, settings);
    settings.passes = 5;
    settings.seed = 400;
    const auto parts = films(scene, settings);
    for (const Layer layer : kClasses) {
      for (int block = -1; block < kSize / kBlock * (kSize / kBlock); ++block) {
        const Estimate a = block_estimate(whole, layer, block), b = block_estimate(parts, layer, block);
        EXPECT_NEAR(a.mean, b.mean, kErrors * std::hypot(a.standard_error, b.standard_error) + 1e-6 * a.mean)
            << kLayerNames[size_t(layer)] << " block " << block;
      }
    }
    write_if_failed(parts[0], "passes");
  }
}

TEST(Passes, FollowTheMemoryLimit) {
  const Scene scene = cornell(kSize);
  RenderSettings settings = settings_of(Method::kPhoton, 8, 0.15f, 1);
  settings.adaptive = 0;  // a single pass would take adaptive samples
  const auto one = render_with_threads(scene, settings);
  EXPECT_EQ(one.statistics.passes, 1u);
  settings.photon_memory = one.statistics.photon_bytes / 2;
  const auto several = render_with_threads(scene, settings);
  EXPECT_GE(several.statistics.passes, 3u);  // the limit includes the maps and the memory of their build
  EXPECT_LE(several.statistics.photon_bytes, settings.photon_memory);
  // The numbers per pass are rounded up and equal for all passes.
  const uint64_t passes = several.statistics.passes;
  EXPECT_GE(several.statistics.photons.emitted, settings.photons);
  EXPECT_LT(several.statistics.photons.emitted, settings.photons + passes);
  EXPECT_GE(several.statistics.rays.camera, one.statistics.rays.camera);
  EXPECT_LT(several.statistics.rays.camera, one.statistics.rays.camera + passes * kSize * kSize);
  EXPECT_TRUE(std::any_of(several.plan.notes.begin(), several.plan.notes.end(),
                          [](const std::string& note) { return note.find("passes") != std::string::npos; }));
}

// Sums of several passes take memory that the photons of one pass could have.
TEST(Passes, SumsLeaveLessToPhotons) {
  const Scene scene = cornell(8);
  const accel::Bvh bvh(scene);
  RenderSettings settings = settings_of(Method::kPhoton, 1, 0.15f, 1);
  settings.photons = 10'000'000;
  EstimatorPlan plan = make_plan(settings, scene.needs);
  settings.photon_memory = 100'000'000;
  const uint64_t alone = choose_passes(scene, bvh, settings, &plan);
  ASSERT_GT(alone, 1u);
  settings.sums_memory = 50'000'000;  // half
  EXPECT_NEAR(double(choose_passes(scene, bvh, settings, &plan)), 2 * double(alone), 1);
  settings.sums_memory = 100'000'000;
  EXPECT_THROW(choose_passes(scene, bvh, settings, &plan), std::runtime_error);
  settings.photon_memory = std::numeric_limits<uint64_t>::max();
  EXPECT_EQ(choose_passes(scene, bvh, settings, &plan), 1u);  // which keeps none
}

TEST(Passes, SameBitsForAnyNumberOfThreads) {
  const Scene scene = cornell(kSize);
  RenderSettings settings = settings_of(Method::kAuto, 4, 0.15f, 1);
  settings.radius.reset();
  settings.passes = 3;
  const auto one = render_with_threads(scene, settings, 1), many = render_with_threads(scene, settings, 3);
  ASSERT_EQ(one.film.width(), many.film.width());
  EXPECT_EQ(std::memcmp(&one.film.at(0, 0), &many.film.at(0, 0), sizeof(PixelResult) * kSize * kSize), 0);
  EXPECT_EQ(one.statistics.photons.stored, many.statistics.photons.stored);
}

// The chosen radius is that of all photons, not of one pass's: k is divided by the number of passes.
TEST(Passes, ChosenRadiiAreForAllPhotons) {
  const Scene scene = cornell(kSize);
  RenderSettings settings = settings_of(Method::kPhoton, 8, 0, 1);
  settings.radius.reset();
  const auto one = render_with_threads(scene, settings);
  settings.passes = 4;
  const auto four = render_with_threads(scene, settings);
  // The distance to the k-th of 1/4 of the photons, k = 16 and 64: at one point it varies by about 1 / (2
  // sqrt(k)), 13 and 6 %, and its median over 1024 points varies less.
  EXPECT_NEAR(four.statistics.direct_radius / one.statistics.direct_radius, 1, 0.13);
  EXPECT_NEAR(four.statistics.indirect_radius / one.statistics.indirect_radius, 1, 0.06);
}

TEST(Passes, RefuseMorePassesThanPhotons) {
  RenderSettings settings = settings_of(Method::kPhoton, 1, 0.15f, 1);
  settings.photons = 3;
  settings.passes = 4;
  EXPECT_THROW(render_with_threads(cornell(8), settings), std::invalid_argument);
}

// A requested number of passes is not raised.
TEST(Passes, RefuseMapsThatDoNotFit) {
  const Scene scene = cornell(8);
  const accel::Bvh bvh(scene);
  RenderSettings settings = settings_of(Method::kPhoton, 1, 0.15f, 1);
  settings.photons = 1'000'000'000'000;
  settings.photon_memory = 1'000'000'000;
  EstimatorPlan plan = make_plan(settings, scene.needs);
  EXPECT_GT(choose_passes(scene, bvh, settings, &plan), 1u);
  settings.passes = 1;
  EXPECT_THROW(choose_passes(scene, bvh, settings, &plan), std::runtime_error);
  settings.passes = 1'000'000;  // 10^6 photons each
  EXPECT_EQ(choose_passes(scene, bvh, settings, &plan), settings.passes);
  settings.passes = 0;
  settings.photons = ~uint64_t{0};
  settings.photon_memory = 10'000;
  EXPECT_THROW(choose_passes(scene, bvh, settings, &plan),
               std::runtime_error);  // would need more than 10^15 passes
}

}  // namespace
}  // namespace kaustik::render
