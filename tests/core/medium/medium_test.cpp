// Tests absorption along a straight way.

#include "core/medium/medium.h"

#include <gtest/gtest.h>

namespace kaustik {
namespace {

// exp(-sigma d) by std::exp of a product that is rounded once: relative error (sigma d + 1) float epsilons.
TEST(Medium, LeavesAnExponentialShare) {
  const Medium medium{{0, 0.5f, 3}};
  for (const float d : {0.0f, 0.1f, 1.0f, 10.0f}) {
    const Rgb left = transmittance(medium, d);
    for (int c = 0; c < 3; ++c) {
      const double depth = double(medium.sigma_a[c]) * double(d), expected = std::exp(-depth);
      EXPECT_NEAR(left[c], expected, expected * (depth + 1) * 0x1p-23) << d << " " << c;
    }
  }
}

TEST(Medium, TakesAllItAbsorbsAlongAnInfiniteWay) {
  EXPECT_EQ(transmittance(Medium{{0, 0.5f, 1e-30f}}, kInfinity), Rgb(1, 0, 0));
}

// Both ways and in parts: what is left of the whole is the product of what is left of the parts.
TEST(Medium, PartsOfAWayMultiply) {
  const Medium medium{{0.25f, 0.5f, 3}};
  const Rgb whole = transmittance(medium, 1), half = transmittance(medium, 0.5f);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(whole[c], half[c] * half[c], 4 * 0x1p-23 * whole[c]);
}

}  // namespace
}  // namespace kaustik
