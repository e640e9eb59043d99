// Tests the measured cost of a pass, and renders that use photons shot before them.

#include "render/passes/pass_trials.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "tests/render/support/image_statistics.h"

namespace kaustik::render {
namespace {

using namespace test;

class PassTrials : public ::testing::Test {
 protected:
  PassTrials() {
    settings_.photons = 30'000;
    settings_.spp = 2;
    // Sources are divided by the number of samples, which trials only settle.
    settings_.caustics = CausticEstimator::kPhotons, settings_.indirect = IndirectEstimator::kPhotons;
    plan_ = make_plan(settings_, scene_.needs);
  }

  RenderInput input() const { return {scene_, bvh_, settings_, plan_}; }

  Scene scene_ = cornell(40);
  accel::Bvh bvh_{scene_};
  RenderSettings settings_;
  EstimatorPlan plan_;
};

TEST(PassCosts, CostOfSamplesIsLinearInBothCounts) {
  const auto seconds = [](double spp, double adaptive) { return 0.25 + spp * (0.5 + 0.125 * adaptive); };
  const SampleCost cost = sample_cost(seconds(1, 0.75), seconds(4, 0), seconds(4, 0.75), 0.75);
  EXPECT_NEAR(cost.fixed, 0.25, 1e-12);
  EXPECT_NEAR(cost.each, 0.5, 1e-12);
  EXPECT_NEAR(cost.each_adaptive, 0.125, 1e-12);
  EXPECT_NEAR(cost.of(16, 2), seconds(16, 2), 1e-12);
  const SampleCost without = sample_cost(seconds(1, 0), seconds(4, 0), seconds(4, 0), 0);
  EXPECT_NEAR(without.of(8, 0), seconds(8, 0), 1e-12);
  EXPECT_EQ(without.each_adaptive, 0);
}

TEST_F(PassTrials, KeepThePhotonsThatTheRenderUses) {
  PhotonTrial trial = try_photons(input(), 1, {});
  ASSERT_TRUE(trial.first.photons.radii());
  EXPECT_GT(trial.first.photons.radii()->indirect, 0);
  try_samples(input(), 1, &trial.first.photons);
  EXPECT_GT(trial.first.photons.maps().indirect.map.size(), 0u);
  EXPECT_EQ(trial.first.photons.visibility(), nullptr);  // it depends on the number of samples
}

// The larger trial gathers with the radii of its own photons, not of the fewer ones that were timed before
// it.
TEST_F(PassTrials, GatherWithTheRadiiOfTheirPhotons) {
  const PhotonTrial few = try_photons(input(), 0, {}), many = try_photons(input(), kInfinity, {});
  ASSERT_GT(many.cost.photons, few.cost.photons);
  settings_.photons = uint64_t(many.cost.photons);
  PassPhotons shot;
  RenderStatistics ignored;
  shot.make(input(), pass_share(0, 1, settings_.photons, 1), {}, &ignored);
  EXPECT_EQ(many.first.photons.radii(), shot.radii());
  EXPECT_EQ(many.first.photons.maps().indirect.estimate.radius, shot.maps().indirect.estimate.radius);
  EXPECT_LT(many.first.photons.radii()->indirect, few.first.photons.radii()->indirect);
}

// When the first trial takes too long no larger one follows, and few windows are rendered.
TEST_F(PassTrials, StopEarlyWhenTheyTakeTooLong) {
  PhotonTrial few = try_photons(input(), 0, {});
  EXPECT_GT(few.cost.each, 0);
  EXPECT_GT(few.first.photons.maps().indirect.map.size(), 0u);
  EXPECT_LE(few.first.photons.maps().indirect.map.size(), 16u * 16384);
  const SampleCost cost = try_samples(input(), 0, &few.first.photons);
  EXPECT_GT(cost.each, 0);
}

// Windows are chosen by squares of the whole image; a crop may contain none of them.
TEST_F(PassTrials, WorkOnTheSmallestCrop) {
  settings_.crop = {39, 40, 17, 18};
  PhotonTrial trial = try_photons(input(), 1, {});
  const double each = try_samples(input(), 1, &trial.first.photons).each;
  EXPECT_TRUE(std::isfinite(each)) << each;
}

// The photons stay valid when the number of samples is chosen after the shoot, and after trials.
TEST_F(PassTrials, PhotonsShotBeforeGiveTheSamePicture) {
  const RenderResult whole = render(scene_, bvh_, settings_);
  RenderSettings before = settings_;
  before.spp = 16;
  auto photons = std::make_shared<FirstPhotons>(shoot_first({scene_, bvh_, before, plan_}, {}));
  try_samples({scene_, bvh_, before, plan_}, 1, &photons->photons);
  const RenderResult result = render(scene_, bvh_, settings_, {}, {.keep_sums = false, .photons = photons});
  const size_t bytes = sizeof(PixelResult) * size_t(result.film.width()) * size_t(result.film.height());
  EXPECT_EQ(std::memcmp(&result.film.at(0, 0), &whole.film.at(0, 0), bytes), 0);
  EXPECT_EQ(result.statistics.photons.stored, whole.statistics.photons.stored);
  EXPECT_EQ(result.statistics.rays.shadow, whole.statistics.rays.shadow);
  EXPECT_EQ(result.statistics.radius, whole.statistics.radius);
  write_if_failed(result.film, "photons_before");
}

// Rounds of adaptive samples end at the same places however their number is decided.
TEST_F(PassTrials, AdaptiveSamplesDecidedOnTheWayGiveTheSamePicture) {
  struct Case {
    float total;
    std::vector<double> answers;  // of the function that decides, one for each round
  };
  const Case cases[] = {
      {0.1f, {double(0.1f)}},
      {0.4f, {double(0.5f), double(0.4f)}},  // a short round, then the rest
      {0.74f, {0.3, 5.0}},                   // more time than it seemed at first, but no longer round follows
      {0.75f, {5.0, 0.75}},
      {2.6f, {5.0, 5.0, double(2.6f), double(2.6f), double(2.6f)}},  // 0.75, 1.125, 1.5, 2.25, 2.6
  };
  for (const Case& c : cases) {
    settings_.adaptive = c.total;
    const RenderResult asked = render(scene_, bvh_, settings_);
    EXPECT_EQ(asked.statistics.adaptive_work, double(c.total));
    size_t rounds = 0;
    const auto decide = [&](double, double seconds) {
      EXPECT_GE(seconds, 0);
      if (rounds < c.answers.size()) return c.answers[rounds++];
      ADD_FAILURE() << c.total << ": asked once more";
      return 0.0;
    };
    settings_.adaptive = 0.1f;
    const RenderResult found = render(scene_, bvh_, settings_, {}, {.adaptive_work = decide});
    EXPECT_EQ(found.statistics.adaptive_work, asked.statistics.adaptive_work);
    EXPECT_EQ(found.statistics.rays.camera, asked.statistics.rays.camera);
    const size_t bytes = sizeof(PixelResult) * size_t(found.film.width()) * size_t(found.film.height());
    EXPECT_EQ(std::memcmp(&found.film.at(0, 0), &asked.film.at(0, 0), bytes), 0) << c.total;
    EXPECT_EQ(rounds, c.answers.size()) << c.total;
  }
}

// No total given as a number is rounded, not even one that a function could not reach after a short round.
TEST_F(PassTrials, AdaptiveSamplesAreAsManyAsAsked) {
  for (const float total : {0.1875f, 0.745f}) {
    settings_.adaptive = total;
    EXPECT_EQ(render(scene_, bvh_, settings_).statistics.adaptive_work, double(total));
  }
}

TEST_F(PassTrials, TellTheSecondsOfASampleWithMapsAndWithPaths) {
  PhotonTrial photons = try_photons(input(), 1, {});
  EXPECT_GT(try_one_sample(input(), kInfinity, &photons.first.photons), 0);
  RenderSettings by_paths = settings_;
  by_paths.caustics = CausticEstimator::kPaths, by_paths.indirect = IndirectEstimator::kPaths;
  const EstimatorPlan plan = make_plan(by_paths, scene_.needs);
  EXPECT_GT(try_one_sample({scene_, bvh_, by_paths, plan}, kInfinity, &photons.first.photons), 0);
}

TEST_F(PassTrials, PhotonsShotBeforeAreForASinglePass) {
  auto photons = std::make_shared<FirstPhotons>(shoot_first(input(), {}));
  settings_.passes = 2;
  EXPECT_THROW(render(scene_, bvh_, settings_, {}, {.photons = photons}), std::invalid_argument);
}

TEST_F(PassTrials, CancelledPhotonsGiveNoPicture) {
  const auto cancel = [](const Progress&) { return false; };
  auto photons = std::make_shared<FirstPhotons>(shoot_first(input(), cancel));
  EXPECT_FALSE(photons->photons.radii());
  const RenderResult result =
      render(scene_, bvh_, settings_, cancel, {.keep_sums = false, .photons = photons});
  EXPECT_TRUE(result.cancelled);
  EXPECT_EQ(result.shown, Shown::kNothing);
}

}  // namespace
}  // namespace kaustik::render
