// What a pass is found to take, and photons that are shot before the render.

#include "render/pass_trials.h"

#include <gtest/gtest.h>

#include <cstring>

#include "tests/render/image_statistics.h"

namespace kaustik::render {
namespace {

using namespace test;

class PassTrials : public ::testing::Test {
 protected:
  PassTrials() {
    settings_.photons = 30'000;
    settings_.spp = 2;
    plan_ = make_plan(settings_, scene_.needs);
  }

  Scene scene_ = cornell(40);
  accel::Bvh bvh_{scene_};
  RenderSettings settings_;
  EstimatorPlan plan_;
};

TEST_F(PassTrials, PhotonsAndSamplesTakeTime) {
  PhotonTrial trial = try_photons(scene_, bvh_, settings_, plan_, {});
  EXPECT_GT(trial.cost.each, 0);
  EXPECT_GE(trial.cost.fixed, 0);
  ASSERT_TRUE(trial.photons.radii);
  EXPECT_GT(trial.photons.radii->indirect, 0);
  const SampleCost cost = try_samples(scene_, bvh_, settings_, plan_, &trial.photons);
  EXPECT_GT(cost.each, 0);
  EXPECT_GE(cost.further, 0);
  EXPECT_GE(cost.of(8, 0.5), cost.of(4, 0.5));
  EXPECT_GE(cost.of(8, 1), cost.of(8, 0.5));
}

TEST_F(PassTrials, WithoutFurtherSamplesTheyTakeNone) {
  settings_.adaptive = 0;
  PhotonTrial trial = try_photons(scene_, bvh_, settings_, plan_, {});
  EXPECT_EQ(try_samples(scene_, bvh_, settings_, plan_, &trial.photons).further, 0);
}

// Windows are chosen by squares of the whole image, of which a crop may hold none.
TEST_F(PassTrials, TakeTheSmallestCrop) {
  settings_.crop = {39, 40, 17, 18};
  PhotonTrial trial = try_photons(scene_, bvh_, settings_, plan_, {});
  EXPECT_GT(try_samples(scene_, bvh_, settings_, plan_, &trial.photons).each, 0);
}

// Also where the number of samples is chosen when the photons are there, and tried.
TEST_F(PassTrials, PhotonsShotBeforeGiveTheSamePicture) {
  const RenderResult whole = render(scene_, bvh_, settings_);
  RenderSettings before = settings_;
  before.spp = 16;
  auto photons = std::make_shared<FirstPhotons>(shoot_first(scene_, bvh_, before, plan_, {}));
  try_samples(scene_, bvh_, before, plan_, photons.get());
  const RenderResult result = render(scene_, bvh_, settings_, {}, {.keep_sums = false, .photons = photons});
  const size_t bytes = sizeof(PixelResult) * size_t(result.film.width()) * size_t(result.film.height());
  EXPECT_EQ(std::memcmp(&result.film.at(0, 0), &whole.film.at(0, 0), bytes), 0);
  EXPECT_EQ(result.statistics.photons.stored, whole.statistics.photons.stored);
  EXPECT_EQ(result.statistics.rays.shadow, whole.statistics.rays.shadow);
  EXPECT_EQ(result.statistics.radius, whole.statistics.radius);
  write_if_failed(result.film, "photons_before");
}

TEST_F(PassTrials, PhotonsShotBeforeAreThoseOfASinglePass) {
  auto photons = std::make_shared<FirstPhotons>(shoot_first(scene_, bvh_, settings_, plan_, {}));
  settings_.passes = 2;
  EXPECT_THROW(render(scene_, bvh_, settings_, {}, {.photons = photons}), std::invalid_argument);
}

TEST_F(PassTrials, CancelledPhotonsGiveNoPicture) {
  const auto cancel = [](const Progress&) { return false; };
  auto photons = std::make_shared<FirstPhotons>(shoot_first(scene_, bvh_, settings_, plan_, cancel));
  EXPECT_FALSE(photons->radii);
  const RenderResult result =
      render(scene_, bvh_, settings_, cancel, {.keep_sums = false, .photons = photons});
  EXPECT_TRUE(result.cancelled);
  EXPECT_EQ(result.shown, Shown::kNothing);
}

}  // namespace
}  // namespace kaustik::render
