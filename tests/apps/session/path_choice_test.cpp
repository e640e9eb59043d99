// Tests where paths take the place of photon maps.

#include "apps/session/stopping/path_choice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random.h"

namespace kaustik::app {
namespace {

using render::PixelHalves;
using render::SampleTrial;

// A trial whose caustic and indirect light have these means in every pixel, beside direct light of 1. noise:
// relative standard deviation of a sample of the indirect light.
SampleTrial trial(double caustic, double indirect, double noise, uint64_t seed) {
  test::Random random(seed);
  constexpr double kUniform = 1.7320508;  // one over the standard deviation of a number between -1 and 1
  SampleTrial trial;
  trial.blocks.resize(400);
  for (auto& block : trial.blocks)
    for (int k = 0; k < 16; ++k) {
      const auto half = [&] {
        return indirect *
               (1 + noise * kUniform * random.uniform(-1, 1) / std::sqrt(render::kTrialSamples / 2));
      };
      const PixelHalves::Pair of_indirect{half(), half()}, of_caustic{caustic, caustic};
      block.push_back(
          {{1 + caustic + of_indirect.first, 1 + caustic + of_indirect.second}, of_caustic, of_indirect});
    }
  return trial;
}

constexpr TakenByPaths kBoth = TakenByPaths::kIndirectAndCaustics;

TEST(PathChoice, VarianceIsThatOfASample) {
  const TrialComparison found = compare_trials(kBoth, trial(0, 1, 0.1, 1), trial(0, 1, 0.5, 2));
  // In units of the squared light 2, and a hundredth for the picture's mean. The square of the difference of
  // two uniform numbers has 7/5 of its square as variance, so the mean of 6400 has 1.4 / 6400 of it; brighter
  // of the two trials is the unit, which adds a few per cent of noise.
  const double unit = 2 * 2 * 1.01;
  EXPECT_NEAR(found.variance_of_maps, 0.01 / unit, 4 * std::sqrt(1.4 / 6400) * 0.01 / unit);
  EXPECT_NEAR(found.variance_of_paths, 0.25 / unit,
              0.03 * 0.25 / unit + 4 * std::sqrt(1.4 / 6400) * 0.25 / unit);
  EXPECT_TRUE(found.paths_are_known);
}

TEST(PathChoice, BiasOfMapsIsToldApartFromNoise) {
  const double unit = 2 * 2 * 1.01;
  const TrialComparison biased = compare_trials(kBoth, trial(0, 0.8, 0.1, 1), trial(0, 1, 0.5, 2));
  EXPECT_NEAR(biased.error_of_maps, 0.2 * 0.2 / unit, 0.1 * 0.2 * 0.2 / unit);
  const TrialComparison same = compare_trials(kBoth, trial(0, 1, 0.1, 1), trial(0, 1, 0.5, 2));
  EXPECT_LT(same.error_of_maps, 0.05 * biased.error_of_maps);
}

TEST(PathChoice, LightThatPathsMissedIsUnknown) {
  const SampleTrial maps = trial(0.1, 1, 0.1, 1);
  SampleTrial paths = trial(0, 1, 0.1, 2);  // saw no caustic, and so no noise of it
  EXPECT_FALSE(compare_trials(kBoth, maps, paths).paths_are_known);
  EXPECT_TRUE(compare_trials(TakenByPaths::kIndirect, maps, paths).paths_are_known);
}

// The noise of paths that a trial did not meet is estimated from those that it met.
TEST(PathChoice, MissingLightOfASmallClassIsNoise) {
  SampleTrial paths = trial(0.002, 1, 0.1, 2);
  const double without = compare_trials(kBoth, trial(0.002, 1, 0.1, 1), paths).variance_of_paths;
  const TrialComparison found = compare_trials(kBoth, trial(0.02, 1, 0.1, 1), paths);
  EXPECT_TRUE(found.paths_are_known);
  // Missing: 0.85 times 0.02 less 0.002. An event is three times a pixel's 0.002 in four samples; the
  // picture's light is 2.002, and its noise in the mean of 6400 pixels is far below a thousandth.
  const double added = (0.85 * 0.02 - 0.002) / 2.002 * (3 * 4 * 0.002 / 2.002);
  EXPECT_NEAR(found.variance_of_paths - without, added, 0.01 * added + 0.02 * without);
}

TEST(PathChoice, LightOfOnePixelIsUnknown) {
  SampleTrial paths = trial(0, 0.001, 0.1, 2);
  PixelHalves& glint = paths.blocks[7][3];
  glint.indirect = {4000, 4000}, glint.all = {4001, 4001};
  EXPECT_FALSE(compare_trials(kBoth, trial(0, 0.6, 0.1, 1), paths).paths_are_known);
}

Scene scene_with(const std::vector<Light>& lights, bool specular) {
  Scene scene;
  scene.lights = lights;
  scene.needs.specular = specular, scene.needs.diffuse = scene.needs.any_light = true;
  return scene;
}

std::vector<TakenByPaths> candidates_of(const Scene& scene, const render::RenderSettings& settings = {}) {
  return path_candidates(scene, settings, render::make_plan(settings, scene.needs));
}

TEST(PathChoice, CausticsOfLightsThatNoPathHitsStayWithMaps) {
  const std::vector<TakenByPaths> of_lamp = candidates_of(scene_with({DiffuseAreaLight{}}, true));
  ASSERT_EQ(of_lamp.size(), 2u);
  EXPECT_EQ(of_lamp[0], TakenByPaths::kIndirect);
  EXPECT_EQ(of_lamp[1], TakenByPaths::kIndirectAndCaustics);
  EXPECT_EQ(candidates_of(scene_with({DiffuseAreaLight{}, PointLight{}}, true)).size(), 1u);
  EXPECT_EQ(candidates_of(scene_with({DiffuseAreaLight{}}, false)).size(), 1u);  // no caustics at all
}

TEST(PathChoice, NamedEstimatorsStay) {
  const Scene scene = scene_with({DiffuseAreaLight{}}, true);
  render::RenderSettings settings;
  settings.caustics = render::CausticEstimator::kPhotons;
  EXPECT_EQ(candidates_of(scene, settings).size(), 1u);
  settings.indirect = render::IndirectEstimator::kFinalGather;
  EXPECT_TRUE(candidates_of(scene, settings).empty());
  settings = {};
  settings.method = render::Method::kPhoton;
  EXPECT_TRUE(candidates_of(scene, settings).empty());
}

}  // namespace
}  // namespace kaustik::app
