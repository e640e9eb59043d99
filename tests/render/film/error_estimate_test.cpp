// Tests standard error, bias and relative error on known sums.

#include "render/film/error_estimate.h"

#include <gtest/gtest.h>

#include "tests/render/support/image_statistics.h"

namespace kaustik::render {
namespace {

using namespace test;

constexpr ExactUnits kUnits{.radiance = -60, .square = -60, .depth = -60};

// A film in which all pixels have the same value, one for each pass.
FilmTotals totals_of(int size, const std::vector<double>& radiance, const std::vector<double>& bias) {
  FilmTotals totals(PixelWindow<PixelTotals>(size, size), kUnits);
  for (size_t i = 0; i < radiance.size(); ++i) {
    FilmSums pass(size, size);
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        PixelSum& p = pass.at(x, y);
        p.direct = glm::dvec3(1, 2, 4) * radiance[i] * 2.0;  // two samples
        p.bias = glm::dvec3(1, 0, -1) * bias[i];
        p.count = 2;
      }
    totals.add(pass);
  }
  return totals;
}

// The integral of Student's density over [-t, t], by Simpson's rule.
double probability_within(double t, double n) {
  const double norm = std::exp(std::lgamma((n + 1) / 2) - std::lgamma(n / 2)) / std::sqrt(n * M_PI);
  const auto density = [&](double x) { return norm * std::pow(1 + x * x / n, -(n + 1) / 2); };
  constexpr int kSteps = 20000;
  double sum = density(0) + density(t);
  for (int i = 1; i < kSteps; ++i) sum += (i % 2 ? 4 : 2) * density(t * i / kSteps);
  return 2 * sum * t / kSteps / 3;
}

TEST(ErrorEstimate, ConfidenceFactorMatchesStudentsT) {
  for (const uint64_t passes : {2, 3, 4, 5, 8, 16, 100, 100000}) {
    const double t = confidence_factor(passes);
    // A change of t by 0.5 % changes the probability by at most 0.005 * 2 t density(t) < 0.002.
    EXPECT_NEAR(probability_within(t, double(passes - 1)), 0.9, 0.002) << passes;
  }
  EXPECT_EQ(confidence_factor(1), kInfinity);
  EXPECT_EQ(confidence_factor(0), kInfinity);
}

// The values 1, 2, 3, 6 have the mean 3 and the sample variance 14 / 3, so the variance of the mean is 14 /
// 12.
TEST(ErrorEstimate, StandardErrorOfTheMean) {
  const ErrorMap errors = estimate_errors(totals_of(3, {1, 2, 3, 6}, {0, 0, 0, 0}));
  const PixelError& p = errors.at(1, 1);
  const float se = std::sqrt(14.0f / 12);
  for (int c = 0; c < 3; ++c) {
    EXPECT_FLOAT_EQ(p.mean[c], 3.0f * float(1 << c));
    EXPECT_FLOAT_EQ(p.error[c], se * float(1 << c));
    EXPECT_EQ(p.bias[c], 0);
  }
}

// The mean bias is 0.5 and the variance of its mean is (4 / 16) / 12 = 1/48. Averaged over nine pixels, which
// count as three, it is 1/144; over the four about a corner 1/64.
TEST(ErrorEstimate, BiasExcludesWhatNoiseExplains) {
  const ErrorMap errors = estimate_errors(totals_of(3, {1, 1, 1, 1}, {0.25, 0.75, 0.25, 0.75}));
  const float middle = std::sqrt(0.25f - 1 / 144.0f), corner = std::sqrt(0.25f - 1 / 64.0f);
  EXPECT_FLOAT_EQ(errors.at(1, 1).bias.x, middle);
  EXPECT_EQ(errors.at(1, 1).bias.y, 0);
  EXPECT_FLOAT_EQ(errors.at(0, 0).bias.z, -corner);
  // For a mean of 1/8 the noise of +-3 explains all of it.
  EXPECT_EQ(estimate_errors(totals_of(3, {1, 1}, {3.125, -2.875})).at(1, 1).bias.x, 0);
}

TEST(ErrorEstimate, OnePassGivesNoEstimate) {
  const FilmTotals totals = totals_of(2, {1}, {0});
  const ErrorMap errors = estimate_errors(totals);
  EXPECT_EQ(errors.at(0, 0).error.x, kInfinity);
  EXPECT_EQ(relative_error(errors, 1), kInfinity);
}

TEST(ErrorEstimate, RelativeErrorIsMeanOrQuantile) {
  ErrorMap errors(10, 1);
  for (int x = 0; x < 10; ++x) errors.at(x, 0) = {Rgb(1), Rgb(0.01f * float(x + 1)), Rgb(0)};
  const double t = confidence_factor(8);
  EXPECT_NEAR(relative_error(errors, 8), t * 0.055, 1e-6);
  EXPECT_NEAR(relative_error(errors, 8, 0.5), t * 0.05, 1e-6);
  EXPECT_NEAR(relative_error(errors, 8, 0.95), t * 0.1, 1e-6);
  EXPECT_NEAR(relative_error(errors, 8, 1.0), t * 0.1, 1e-6);
  EXPECT_NEAR(relative_error(errors, 8, 1e-9), t * 0.01, 1e-6);
}

// The error of a black pixel is relative to a tenth of the mean; noise and bias add as squares; scaling
// changes nothing.
TEST(ErrorEstimate, RelativeErrorOfDarkAndBiasedPixels) {
  for (const float scale : {1.0f, 0x1p-40f}) {
    ErrorMap errors(2, 1);
    errors.at(0, 0) = {Rgb(2 * scale), Rgb(0.03f * scale), Rgb(-0.04f * scale)};
    errors.at(1, 0) = {Rgb(0), Rgb(0.01f * scale), Rgb(0)};
    // (0.05 / 2 + 0.01 / 0.1) / 2
    EXPECT_NEAR(relative_error(errors, 8), confidence_factor(8) * 0.0625, 1e-6);
  }
}

// Estimates that subtract light leave noise below zero.
TEST(ErrorEstimate, NegativeMeansCountByTheirMagnitude) {
  ErrorMap errors(1, 1);
  errors.at(0, 0) = {Rgb(-2), Rgb(0.1f), Rgb(0)};
  EXPECT_NEAR(relative_error(errors, 8), confidence_factor(8) * 0.05, 1e-6);
  errors.at(0, 0).mean = Rgb(0);
  EXPECT_EQ(relative_error(errors, 8), kInfinity);
}

TEST(ErrorEstimate, BlackPicturesHaveNoError) {
  EXPECT_EQ(relative_error(estimate_errors(totals_of(2, {0, 0}, {0, 0})), 2), 0);
}

}  // namespace
}  // namespace kaustik::render
