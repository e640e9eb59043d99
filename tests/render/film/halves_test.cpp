// Tests the sums over one half of the samples.

#include "render/film/halves.h"

#include <gtest/gtest.h>

#include "render/film/film_totals.h"
#include "tests/support/random.h"

namespace kaustik::render {
namespace {

constexpr ExactUnits kUnits{-60, -60, -60};
constexpr size_t kDirect = half_of(Layer::kDirect), kCaustic = half_of(Layer::kCaustic);

TEST(Halves, BothHoldSamplesFromTheSecondOn) {
  for (uint64_t samples = 2; samples <= 64; ++samples) {
    uint64_t count = 0;
    for (uint64_t i = 0; i < samples; ++i) count += in_half(i, samples);
    EXPECT_GE(count, samples / 4) << samples;
    EXPECT_LE(count, (samples + 1) / 2) << samples;
  }
}

TEST(Halves, BothHoldPassesFromTheSecondOn) {
  for (const uint64_t samples : {1, 2, 3, 4, 16})
    for (uint64_t shares = 2; shares <= 64; ++shares) {
      uint64_t count = 0;
      for (uint64_t pass = 0; pass < shares; ++pass) count += pass_in_half(pass, shares, samples);
      EXPECT_GE(count, shares / 4) << samples << ' ' << shares;
      EXPECT_LE(count, (shares + 1) / 2) << samples << ' ' << shares;
      EXPECT_GE(count, 1u) << samples << ' ' << shares;
    }
}

// A pixel's samples, of which every third computes traced light alone.
struct Samples {
  PixelSum all;
  HalfSum half;
  std::array<double, 2> direct{}, caustic{}, count{}, with_maps{};  // of either half
};
Samples random_samples(bool traced) {
  test::Random random(11);
  Samples out;
  for (uint64_t i = 0; i < 24; ++i) {
    const SampleLight light = traced && i >= 12 && i % 3 == 0 ? SampleLight::kTraced : SampleLight::kAll;
    PixelResult sample;
    sample.direct = Rgb(random.uniform());
    if (light == SampleLight::kAll) sample.caustic = Rgb(random.uniform());
    const size_t half = in_half(i, 8);
    out.all.add(sample, 1, light);
    if (half) out.half.add(sample, 1, light);
    out.direct[half] += double(sample.direct.x), out.caustic[half] += double(sample.caustic.x);
    ++out.count[half];
    out.with_maps[half] += light == SampleLight::kAll;
  }
  return out;
}

// The means over each half's own samples, those of the maps over the samples that computed them.
TEST(Halves, HaveTheMeansOfTheirSamples) {
  for (const bool traced : {false, true}) {
    const Samples samples = random_samples(traced);
    FilmSums sums(1, 1);
    HalfSums half(1, 1);
    sums.at(0, 0) = samples.all, half.at(0, 0) = samples.half;
    const HalfMeans means = halves_of(sums, half, kUnits).at(0, 0);
    for (size_t h = 0; h < 2; ++h) {
      EXPECT_NEAR(double(means.mean[h][kDirect]), samples.direct[h] / samples.count[h], 1e-6);
      EXPECT_NEAR(double(means.mean[h][kCaustic]), samples.caustic[h] / samples.with_maps[h], 1e-6);
      EXPECT_FLOAT_EQ(means.share[h], float(samples.count[h] / 24));
    }
  }
}

// What maps contribute is made up for in each pass by itself: a pass of many traced samples counts as one of
// few.
TEST(Halves, MakeUpForTracedSamplesPassByPass) {
  FilmTotals totals(PixelWindow<PixelTotals>(1, 1), kUnits);
  totals.keep_halves();
  std::array<double, 2> sum{}, weight{};
  for (const bool traced : {false, true}) {
    const Samples samples = random_samples(traced);
    FilmSums sums(1, 1);
    HalfSums half(1, 1);
    sums.at(0, 0) = samples.all, half.at(0, 0) = samples.half;
    totals.add(sums, &half);
    for (size_t h = 0; h < 2; ++h) {
      sum[h] += samples.caustic[h] / samples.with_maps[h] * samples.count[h];
      weight[h] += samples.count[h];
    }
  }
  const HalfMeans means = totals.halves().at(0, 0);
  for (size_t h = 0; h < 2; ++h) EXPECT_NEAR(double(means.mean[h][kCaustic]), sum[h] / weight[h], 1e-6);
}

TEST(Halves, OfPassesAreTheOddOnesInAnyOrder) {
  test::Random random(12);
  std::vector<FilmSums> passes;
  std::array<double, 2> sum{}, count{};
  for (size_t pass = 0; pass < 5; ++pass) {
    passes.emplace_back(1, 1);
    for (int i = 0; i < 4; ++i) {
      PixelResult sample;
      sample.direct = Rgb(random.uniform());
      passes.back().at(0, 0).add(sample);
      sum[pass % 2] += double(sample.direct.x), ++count[pass % 2];
    }
  }
  const auto totals_of = [&](std::initializer_list<size_t> order) {
    FilmTotals totals(PixelWindow<PixelTotals>(1, 1), kUnits);
    totals.keep_halves();
    for (const size_t pass : order) pass % 2 ? totals.add_as_half(passes[pass]) : totals.add(passes[pass]);
    return totals;
  };
  const FilmTotals whole = totals_of({0, 1, 2, 3, 4});
  const HalfMeans means = whole.halves().at(0, 0);
  for (size_t h = 0; h < 2; ++h) EXPECT_NEAR(double(means.mean[h][kDirect]), sum[h] / count[h], 1e-6);
  FilmTotals merged = totals_of({3, 0});
  merged.add(totals_of({4, 2, 1}));
  EXPECT_EQ(merged.half_pixels().at(0, 0), whole.half_pixels().at(0, 0));
  EXPECT_EQ(merged.pixels().at(0, 0), whole.pixels().at(0, 0));
}

TEST(Halves, OfOneFilmAloneCannotBeAdded) {
  FilmTotals with(PixelWindow<PixelTotals>(1, 1), kUnits), without(PixelWindow<PixelTotals>(1, 1), kUnits);
  with.keep_halves();
  EXPECT_THROW(with.add(without), std::invalid_argument);
  EXPECT_THROW(without.add(with), std::invalid_argument);
}

TEST(Halves, AreUnknownWhereOneHasNoSamples) {
  FilmSums sums(1, 1);
  HalfSums half(1, 1);
  PixelResult sample;
  sample.direct = Rgb(1);
  sums.at(0, 0).add(sample);
  EXPECT_EQ(halves_of(sums, half, kUnits).at(0, 0).share[0], 0);
}

}  // namespace
}  // namespace kaustik::render
