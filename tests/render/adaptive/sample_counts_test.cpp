// Tests adaptive sampling: the estimates from the first samples, the numbers of adaptive samples, and that
// the mean stays unbiased.

#include "render/adaptive/sample_counts.h"

#include <gtest/gtest.h>

#include <random>

#include "render/film/film_totals.h"
#include "tests/render/support/image_statistics.h"

namespace kaustik::render {
namespace {

using namespace test;

// Every pixel has `count` samples with the values value(x, y, i).
template <class Fn>
BlockMoments moments_of(int count, const Fn& value) {
  BlockMoments block;
  for (int y = 0; y < kRayBlock; ++y)
    for (int x = 0; x < kRayBlock; ++x)
      for (int i = 0; i < count; ++i) {
        SampleMoments& pixel = block[pixel_of_block(x, y)];
        for (LightMoments& light : pixel.light) light.add(Rgb(value(x, y, i)), 3);
        ++pixel.count;
      }
  return block;
}

double variance_of(const BlockMoments& block, int half) {
  return spread_of(block, half).of(SampleLight::kAll).variance;
}

// Two bounds of the variance: the variance of the samples within a pixel, and the deviation of the pixels'
// means from a plane over the block. A block whose means lie on a plane has no noise, however much the
// samples of a pixel differ; pixels whose samples are equal have none, however crooked the block.
TEST(SampleSpread, IsTheSmallerOfTwoBounds) {
  const auto plane = moments_of(2, [](int x, int y, int i) {
    return 8.0f + 0.5f * float(x) - 0.25f * float(y) + (i == 0 ? 1.0f : -1.0f);
  });
  const auto crooked = moments_of(2, [](int x, int y, int) { return float(1 + x * x * y); });
  for (int half = 0; half < kHalves; ++half) {
    EXPECT_EQ(variance_of(plane, half), 0);
    EXPECT_EQ(variance_of(crooked, half), 0);
    EXPECT_EQ(spread_of(plane, half).pixels, 8);
    EXPECT_EQ(spread_of(plane, half).of(SampleLight::kTraced).work, 8 * 3);
    EXPECT_DOUBLE_EQ(spread_of(plane, half).mean, 8 * (8 + 0.5 * 1.5 - 0.25 * 1.5));
  }
}

// For independent samples both bounds are unbiased. The smaller of the two is less, but with 4 samples in 8
// pixels, and 5 degrees of freedom of means, seldom less than half of the variance.
TEST(SampleSpread, EstimatesTheVarianceOfNoise) {
  std::mt19937 random(1);
  std::normal_distribution<float> noise(5, 2);
  double sum = 0;
  constexpr int kBlocks = 400;
  for (int i = 0; i < kBlocks; ++i)
    sum += variance_of(moments_of(4, [&](int, int, int) { return noise(random); }), i % 2) / 8;
  const double of_one = sum / kBlocks / 3;  // variance of one channel
  EXPECT_LT(of_one, 4);
  EXPECT_GT(of_one, 2);
}

// Pixels outside the window have no samples, and no plane is fitted to the others.
TEST(SampleSpread, CutBlocksUseTheVarianceWithinPixels) {
  auto block = moments_of(2, [](int, int, int i) { return i == 0 ? 1.0f : 3.0f; });
  for (int y = 0; y < kRayBlock; ++y) block[pixel_of_block(3, y)] = {};
  for (int half = 0; half < kHalves; ++half) {
    const SampleSpread spread = spread_of(block, half);
    EXPECT_EQ(spread.pixels, 6);
    EXPECT_EQ(spread.of(SampleLight::kAll).variance, 6 * 3 * 2);
  }
}

constexpr int kBlocks = 12, kPixels = kBlocks * kRayBlock;

// The spread of half a block, per pixel; the mean is 1.
SampleSpread spread_by(const LightSpread& all, const LightSpread& traced = {}) {
  SampleSpread spread{{all, traced}, 1.0, 1.0}, half;
  half.add(spread, 8);
  return half;
}

// spread(x, y, half) is the spread of a half of block (x, y).
template <class Fn>
SampleCounts counts_of(const Fn& spread, uint64_t first, double adaptive_work) {
  SampleCounts counts{FilmSums(kPixels, kPixels)};
  for (int y = 0; y < kPixels; y += kRayBlock)
    for (int x = 0; x < kPixels; x += kRayBlock)
      for (int half = 0; half < kHalves; ++half)
        counts.spread(x, y, half) = spread(x / kRayBlock, y / kRayBlock, half);
  counts.choose_counts(first, adaptive_work);
  return counts;
}

// The variances rise from 1 to 2^44 from left to right. The fourth root asks for 2^11 times the samples, of
// which 2^6 are allowed.
TEST(SampleCounts, StayWithinTheWorkAndFollowTheRootOfTheVariance) {
  constexpr uint64_t kFirst = 2;
  constexpr double kAdaptive = 7;
  const auto spread = [](int x, int, int) { return spread_by({std::ldexp(1.0, 4 * x), 1.0}); };
  const auto counts = counts_of(spread, kFirst, kAdaptive);
  uint64_t sum = 0;
  for (int y = 0; y < kPixels; y += kRayBlock) {
    uint64_t last = kFirst;
    for (int x = 0; x < kPixels; x += kRayBlock)
      for (int half = 0; half < kHalves; ++half) {
        const uint64_t count = counts.count(x, y, half);
        EXPECT_GE(count, last);
        EXPECT_LE(count, kFirst << 6);
        last = count, sum += count;
      }
    EXPECT_GT(last, kFirst * 16);
  }
  const double all = kFirst * (1 + kAdaptive) * kBlocks * kBlocks * kHalves;
  EXPECT_LE(double(sum), all);
  EXPECT_GT(double(sum), all / 2);  // doubling every count would exceed the work
}

// More work never takes samples away, and the counts of the round before are kept.
TEST(SampleCounts, GrowFromRoundToRound) {
  const auto spread = [](int x, int y, int) { return spread_by({std::ldexp(1.0, 3 * x + y), 1.0}); };
  SampleCounts counts = counts_of(spread, 4, 0.75);
  const auto each = [](const auto& check) {
    for (int y = 0; y < kPixels; y += kRayBlock)
      for (int x = 0; x < kPixels; x += kRayBlock)
        for (int half = 0; half < kHalves; ++half) check(x, y, half);
  };
  each([&](int x, int y, int half) { EXPECT_EQ(counts.count_before(x, y, half), 4u); });
  const SampleCounts first = counts;
  counts.choose_counts(4, 3);
  uint64_t more = 0;
  each([&](int x, int y, int half) {
    EXPECT_EQ(counts.count_before(x, y, half), first.count(x, y, half));
    EXPECT_GE(counts.count(x, y, half), first.count(x, y, half));
    more += counts.count(x, y, half) - first.count(x, y, half);
  });
  EXPECT_GT(more, 0u);
}

TEST(SampleCounts, AreEvenWhereNothingDiffers) {
  const auto even = [](double variance) { return [=](int, int, int) { return spread_by({variance, 1.0}); }; };
  const auto dark = counts_of(even(0), 4, 3), noisy = counts_of(even(0.1), 4, 3),
             noisy_but_expensive = counts_of(even(0.1), 4, 0.5);
  for (int x = 0; x < kPixels; x += kRayBlock) {
    EXPECT_EQ(dark.count(x, x, 0), 4u);
    EXPECT_EQ(noisy.count(x, x, 1), 16u);
    EXPECT_EQ(noisy_but_expensive.count(x, x, 1), 4u);
  }
}

// The number of a pixel's samples must not depend on their values.
TEST(SampleCounts, DoNotDependOnThePixelsOwnSamples) {
  const auto with_spot = [](double spot) {
    const auto spread = [=](int x, int y, int half) {
      return spread_by({x == 5 && y == 5 && half == 0 ? spot : 1.0, 1.0});
    };
    return counts_of(spread, 4, 3);
  };
  const auto plain = with_spot(1), bright = with_spot(1e6);
  const int at = 5 * kRayBlock;
  EXPECT_LE(bright.count(at, at, 0), plain.count(at, at, 0));  // other pixels take more of the work
  EXPECT_GT(bright.count(at, at, 1), plain.count(at, at, 1));
  EXPECT_GT(bright.count(at + kRayBlock, at, 0), plain.count(at + kRayBlock, at, 0));
}

// Expensive samples are taken less often: half as many where they cost sixteen times as much.
TEST(SampleCounts, FallWithTheCostOfSamples) {
  const auto spread = [](int x, int, int) { return spread_by({1.0, x < kBlocks / 2 ? 1.0 : 16.0}); };
  const auto counts = counts_of(spread, 4, 3);
  EXPECT_EQ(counts.count(0, 24, 0), 2 * counts.count(kPixels - 1, 24, 0));
}

// Of eight samples, two query the photon maps, and their result stands for the six that trace rays only.
TEST(SampleCounts, TracedSamplesKeepTheResultOfTheMaps) {
  FilmSums film(1, 1);
  for (int i = 0; i < 8; ++i) {
    PixelResult sample;
    sample.direct = Rgb(float(i));
    const bool traced = i >= 2;
    if (!traced) sample.caustic = Rgb(3), sample.indirect = Rgb(1 + 2.0f * float(i)), sample.photons = 10;
    film.at(0, 0).add(sample, 1, traced ? SampleLight::kTraced : SampleLight::kAll);
  }
  uint64_t clamped = 0;
  const PixelResult mean = mean_of(film, {.radiance = -60, .square = -60, .depth = -60}, &clamped).at(0, 0);
  EXPECT_EQ(mean.direct, Rgb(3.5f));
  EXPECT_EQ(mean.caustic, Rgb(3));
  EXPECT_EQ(mean.indirect, Rgb(2));
  EXPECT_EQ(mean.photons, 10);
  EXPECT_EQ(clamped, 0u);
}

// Traced light alone is sampled where it varies more for its cost: at half the work of all light, 3.5 times
// the work of the first samples buys seven times as many samples.
TEST(SampleCounts, SkipTheMapsWhereTracedLightVariesMore) {
  const auto counts_for = [](const LightSpread& all, const LightSpread& traced) {
    return counts_of([&](int, int, int) { return spread_by(all, traced); }, 4, 3.5);
  };
  const auto by_lights = counts_for({1.0, 2.0}, {0.8, 1.0}), by_maps = counts_for({1.0, 2.0}, {0.4, 1.0});
  EXPECT_EQ(by_lights.light(0, 0, 0), SampleLight::kTraced);
  EXPECT_EQ(by_lights.count(0, 0, 0), 32u);
  EXPECT_EQ(by_maps.light(0, 0, 0), SampleLight::kAll);
  EXPECT_EQ(by_maps.count(0, 0, 0), 16u);
}

// The light's edges and its image in the glass ball differ most within pixels. Renders with many seeds, with
// and without adaptive sampling, are compared by blocks of pixels: no mean may shift, and the picture's noise
// must fall.
class SpreadSamples : public ::testing::Test {
 protected:
  static constexpr int kSide = 48, kSeeds = 40, kPart = 16;

  static std::vector<Film> films(float adaptive, uint64_t seed) {
    const Scene scene = cornell(kSide);
    RenderSettings settings;
    settings.photons = 20'000;
    settings.spp = 8;
    settings.adaptive = adaptive;
    settings.indirect = IndirectEstimator::kPhotons, settings.caustics = CausticEstimator::kPhotons;
    std::vector<Film> out;
    for (settings.seed = seed; out.size() < kSeeds; ++settings.seed)
      out.push_back(render_with_threads(scene, settings).film);
    return out;
  }

  static Estimate mean_of(const std::vector<Film>& films, int x0, int y0) {
    std::vector<double> means;
    for (const Film& film : films) {
      Rgb sum(0);
      for (int y = y0; y < y0 + kPart; ++y)
        for (int x = x0; x < x0 + kPart; ++x) sum += film.at(x, y).radiance();
      means.push_back(double(sum.x + sum.y + sum.z));
    }
    return estimate_of(means);
  }

  // The variance over the picture of the light that reaches the eye without photons.
  static double variance(const std::vector<Film>& films) {
    double sum = 0;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        std::vector<double> values;
        for (const Film& film : films)
          values.push_back(double((film.at(x, y).emitted + film.at(x, y).direct).y));
        const Estimate e = estimate_of(values);
        sum += e.standard_error * e.standard_error / (e.mean * e.mean + 0.01);
      }
    return sum;
  }
};

TEST_F(SpreadSamples, KeepTheMeanAndReduceTheNoise) {
  const auto even = films(0, 1), spread = films(0.75f, 1001);
  for (int y = 0; y < kSide; y += kPart)
    for (int x = 0; x < kSide; x += kPart) {
      const Estimate a = mean_of(even, x, y), b = mean_of(spread, x, y);
      // 4.5 standard errors with 78 degrees of freedom; by chance, one of nine blocks exceeds them once in
      // 4000 runs.
      EXPECT_NEAR(b.mean, a.mean, 4.5 * std::hypot(a.standard_error, b.standard_error)) << x << " " << y;
    }
  // Half as many samples again, spent evenly, would leave 1 / 1.5 of the variance of independent samples.
  // Edges hold most of the variance, and its own variance from 40 seeds is large.
  EXPECT_LT(variance(spread), variance(even) / 1.5);
  write_if_failed(spread[0], "spread");
}

}  // namespace
}  // namespace kaustik::render
