// Tests the layers of media, which are summed apart.

#include "render/film/media_sums.h"

#include <gtest/gtest.h>

#include "render/film/film_totals.h"
#include "tests/support/random.h"

namespace kaustik::render {
namespace {

constexpr ExactUnits kUnits{-70, -40, -70};

struct Pass {
  FilmSums sums{1, 1};
  MediaSums media{1, 1};

  void add(const PixelResult& sample, SampleLight light) {
    sums.at(0, 0).add(sample, 1, light);
    media.at(0, 0).add(sample, 1);
  }
};

// Samples of which some leave out what comes from maps.
Pass random_pass(uint64_t seed, double* direct, double* caustic) {
  test::Random random(seed);
  Pass pass;
  double direct_sum = 0, caustic_sum = 0;
  for (int i = 0; i < 12; ++i) {
    PixelResult sample;
    sample.media_direct = Rgb(random.uniform());
    const SampleLight light = i % 3 == 0 ? SampleLight::kAll : SampleLight::kTraced;
    if (light == SampleLight::kAll) sample.media_caustic = Rgb(random.uniform());
    direct_sum += double(sample.media_direct.x), caustic_sum += double(sample.media_caustic.x);
    pass.add(sample, light);
  }
  *direct = direct_sum / 12, *caustic = caustic_sum / 4;
  return pass;
}

TEST(MediaSums, MeansMakeUpForTracedSamples) {
  double direct[2], caustic[2];
  FilmTotals totals(PixelWindow<PixelTotals>(1, 1), kUnits);
  totals.keep_media();
  for (size_t i = 0; i < 2; ++i) {
    const Pass pass = random_pass(i, &direct[i], &caustic[i]);
    uint64_t clamped = 0;
    const PixelResult alone = mean_of(pass.sums, kUnits, &clamped, &pass.media).at(0, 0);
    EXPECT_NEAR(double(alone.media_direct.x), direct[i], 1e-6);
    EXPECT_NEAR(double(alone.media_caustic.y), caustic[i], 1e-6);
    EXPECT_EQ(totals.add(pass.sums, nullptr, &pass.media) + clamped, 0u);
  }
  const PixelResult both = totals.mean().at(0, 0);
  EXPECT_NEAR(double(both.media_direct.z), (direct[0] + direct[1]) / 2, 1e-6);
  EXPECT_NEAR(double(both.media_caustic.x), (caustic[0] + caustic[1]) / 2, 1e-6);
}

TEST(MediaSums, AnyOrderGivesTheSameBits) {
  const auto totals_of = [&](std::initializer_list<uint64_t> order) {
    FilmTotals totals(PixelWindow<PixelTotals>(1, 1), kUnits);
    totals.keep_media();
    for (const uint64_t seed : order) {
      double direct, caustic;
      const Pass pass = random_pass(seed, &direct, &caustic);
      totals.add(pass.sums, nullptr, &pass.media);
    }
    return totals;
  };
  const FilmTotals whole = totals_of({0, 1, 2, 3});
  FilmTotals merged = totals_of({3, 1});
  merged.add(totals_of({2, 0}));
  EXPECT_EQ(merged.media_pixels().at(0, 0), whole.media_pixels().at(0, 0));
}

TEST(MediaSums, OfOneFilmAloneCannotBeAdded) {
  FilmTotals with(PixelWindow<PixelTotals>(1, 1), kUnits), without(PixelWindow<PixelTotals>(1, 1), kUnits);
  with.keep_media();
  EXPECT_THROW(with.add(without), std::invalid_argument);
  EXPECT_THROW(without.add(with), std::invalid_argument);
}

}  // namespace
}  // namespace kaustik::render
