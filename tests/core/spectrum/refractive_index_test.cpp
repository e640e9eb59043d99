// Tests indices of refraction against the makers' data sheets.

#include "core/spectrum/refractive_index.h"

#include <gtest/gtest.h>

namespace kaustik {
namespace {

constexpr double kF = 486.13, kC = 656.28;

double abbe_number(const Spectrum& n) {
  return (n.at(kHeliumLine) - 1) / (n.at(kF) - n.at(kC));
}

// n_d and the Abbe number as Schott prints them.
TEST(RefractiveIndex, GlassesHaveThePublishedNumbers) {
  const struct {
    const char* name;
    double n_d, abbe;
  } published[] = {{"glass-BK7", 1.51680, 64.17},   {"glass-BAF10", 1.67003, 47.11},
                   {"glass-FK51A", 1.48656, 84.47}, {"glass-LASF9", 1.85025, 32.17},
                   {"glass-F5", 1.67271, 32.25},    {"glass-SF10", 1.72828, 28.53},
                   {"glass-F11", 1.78472, 25.68}};
  for (const auto& p : published) {
    const SellmeierCoefficients* glass = glass_coefficients(p.name);
    ASSERT_TRUE(glass) << p.name;
    const Spectrum n = sellmeier_index(*glass);
    EXPECT_NEAR(n.at(kHeliumLine), p.n_d, 1e-5) << p.name;
    EXPECT_NEAR(abbe_number(n), p.abbe, 0.03) << p.name;
  }
  EXPECT_EQ(glass_coefficients("glass-BK8"), nullptr);
}

// Between whole nanometres indices are interpolated, which changes them by less than 1e-6.
TEST(RefractiveIndex, AbbeNumberGivesTheIndexAndTheNumber) {
  const Spectrum n = abbe_index(1.62, 36);
  EXPECT_NEAR(n.at(kHeliumLine), 1.62, 1e-6);
  EXPECT_NEAR(abbe_number(n), 36, 0.01);
}

TEST(RefractiveIndex, CauchyIsAPolynomial) {
  const Spectrum n = cauchy_index(std::array{1.5, 0.01, 0.002});
  EXPECT_NEAR(n.at(500), 1.5 + 0.01 / 0.25 + 0.002 / 0.0625, 1e-12);
}

TEST(RefractiveIndex, SamplesAreInterpolatedAndRepeatedBeyondTheEnds) {
  const Spectrum n = sampled_index(std::array{450.0, 1.6, 650.0, 1.4});
  EXPECT_NEAR(n.at(500), 1.55, 1e-12);
  EXPECT_EQ(n.at(400), 1.6);
  EXPECT_EQ(n.at(450), 1.6);
  EXPECT_EQ(n.at(650), 1.4);
  EXPECT_EQ(n.at(700), 1.4);
}

TEST(RefractiveIndex, PolesAndNegativeSquaresAreFound) {
  EXPECT_TRUE(valid_index(abbe_index(1.5, 60)));
  EXPECT_FALSE(valid_index(sellmeier_index({1, 0, 0, 0.25, 0, 0})));  // a pole at 500 nm
  EXPECT_FALSE(valid_index(cauchy_index(std::array{-1.0})));
}

}  // namespace
}  // namespace kaustik
