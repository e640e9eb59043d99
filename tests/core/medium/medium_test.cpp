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

// The emission of a thin part is sigma_a Le times its length; that of a deep one Le, or, where it also
// scatters, the share sigma_a / sigma_t of it. expm1 and one product and quotient: 4 float epsilons.
TEST(Medium, EmitsMoreTheDeeperItIs) {
  const Medium medium{{0, 0.5f, 3}, {1, 0.5f, 0}, 0, nullptr, {7, 8, 2}};
  const Rgb thin = emitted_radiance(medium, 1e-7f), deep = emitted_radiance(medium, kInfinity);
  EXPECT_EQ(thin.x, 0);
  EXPECT_NEAR(thin.y, 1e-7f * 0.5f * 8, 4e-7f * 4 * 0x1p-23);
  EXPECT_NEAR(thin.z, 1e-7f * 3 * 2, 6e-7f * (4 * 0x1p-23 + 1.5e-7));
  EXPECT_EQ(deep, Rgb(0, 4, 2));
  EXPECT_TRUE(medium.emits());
  EXPECT_FALSE((Medium{{0, 1, 0}, Rgb(1), 0, nullptr, {1, 0, 1}}.emits()));
}

// What a whole emits is what its near part emits, and what the near part lets through of the far one.
TEST(Medium, EmissionOfPartsAddsUp) {
  const Medium medium{{0.25f, 0.5f, 3}, {0.5f, 0, 1}, 0, nullptr, {1, 2, 3}};
  const Rgb whole = emitted_radiance(medium, 1), half = emitted_radiance(medium, 0.5f);
  const Rgb sum = half + transmittance(medium, 0.5f) * half;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(whole[c], sum[c], 8 * 0x1p-23 * whole[c]);
}

}  // namespace
}  // namespace kaustik
