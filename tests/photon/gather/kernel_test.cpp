#include "photon/gather/kernel.h"

#include <gtest/gtest.h>

namespace kaustik::photon {
namespace {

// The integral of K over its disc, 2 pi int_0^r K(d) d dd, by the midpoint rule in double.
double integral(const KernelSpec& kernel, float radius) {
  constexpr int kSteps = 20000;
  const KernelTerms terms = kernel_terms(kernel, radius);
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double d = (i + 0.5) / kSteps * double(radius);
    sum += double(kernel_value(kernel.type, terms, float(d * d))) * d;
  }
  return 2 * std::numbers::pi * sum * double(radius) / kSteps;
}

// The midpoint rule's error for these cubics and quartics is below 1 / kSteps^2 of the integral. The rest is
// the rounding of scale and slope to float, a few units in the last place.
constexpr double kBound = 16 * double(std::numeric_limits<float>::epsilon());

TEST(Kernel, IntegratesToOneOverItsDisc) {
  for (const float radius : {1e-4f, 0.3f, 1.0f, 250.0f}) {
    for (const KernelType type : kKernelTypes)
      for (const float k : {1.0f, 1.1f, 2.0f, 100.0f})
        EXPECT_NEAR(integral({type, k}, radius), 1, kBound) << kKernels[size_t(type)].name;
  }
}

TEST(Kernel, MatchesItsClosedFormsAtCentreAndRim) {
  const float r = 0.5f, area = kPi * r * r;
  const auto at = [&](KernelSpec kernel, float d) {
    return kernel_value(kernel.type, kernel_terms(kernel, r), d * d);
  };
  EXPECT_FLOAT_EQ(at({KernelType::kConstant, 1}, r), 1 / area);
  EXPECT_FLOAT_EQ(at({KernelType::kEpanechnikov, 1}, 0), 2 / area);
  EXPECT_FLOAT_EQ(at({KernelType::kEpanechnikov, 1}, r), 0);
  EXPECT_FLOAT_EQ(at({KernelType::kCone, 1}, 0), 3 / area);
  EXPECT_FLOAT_EQ(at({KernelType::kCone, 1}, r), 0);
  EXPECT_FLOAT_EQ(at({KernelType::kCone, 2}, r), 0.5f / (2.0f / 3) / area);
}

TEST(Kernel, DiscWithoutAreaHasZeroDensity) {
  for (const float radius : {0.0f, -1.0f, kInfinity, std::numeric_limits<float>::quiet_NaN()}) {
    EXPECT_EQ(kernel_terms({}, radius).scale, 0) << radius;
  }
}

}  // namespace
}  // namespace kaustik::photon
