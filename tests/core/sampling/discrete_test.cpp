#include "core/sampling/discrete.h"

#include <gtest/gtest.h>

#include "tests/core/support/chi_square.h"
#include "tests/support/random.h"

namespace kaustik {
namespace {

TEST(DiscreteDistribution, FollowsItsWeights) {
  std::vector<double> weights;
  for (int i = 0; i < 16; ++i) weights.push_back(i % 3 == 0 ? 0.0 : 0.25 * i * i);
  const DiscreteDistribution d(weights);
  test::Random random(5);
  constexpr int kSamples = 200000;
  std::vector<int64_t> observed(16, 0);
  std::vector<double> expected(16, 0);
  for (int i = 0; i < kSamples; ++i) ++observed[d.sample(random.uniform()).index];
  for (uint32_t i = 0; i < 16; ++i) {
    expected[i] = kSamples * weights[i] / d.total();
    // The cumulative sum is exact to double rounding, and the result is rounded to float once.
    EXPECT_NEAR(d.pdf(i), weights[i] / d.total(), 1e-7);
    if (weights[i] == 0) {
      EXPECT_EQ(observed[i], 0);
    }
  }
  EXPECT_GT(test::pooled_p_value(expected, observed), 0.01);
}

TEST(DiscreteDistribution, NeverChoosesZeroWeightAtTheEnds) {
  const DiscreteDistribution d({0, 0, 1, 0, 3, 0});
  EXPECT_EQ(d.sample(0).index, 2u);
  EXPECT_EQ(d.sample(std::nextafter(0.25f, 0.0f)).index, 2u);
  EXPECT_EQ(d.sample(0.25f).index, 4u);
  EXPECT_EQ(d.sample(kOneMinusEpsilon).index, 4u);
  // Ten equal weights do not sum to their total exactly in floating point; a u close to one must still find
  // the last of them.
  const DiscreteDistribution tenths({0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0});
  EXPECT_EQ(tenths.sample(kOneMinusEpsilon).index, 9u);
}

// The remainder is linear in u within each entry, so it is uniform again: scaled back, it gives u.
TEST(DiscreteDistribution, RemapsUniformly) {
  const DiscreteDistribution d({1, 2, 5});
  const float before[] = {0, 1.0f / 8, 3.0f / 8};
  for (int i = 0; i < 1000; ++i) {
    const float u = static_cast<float>(i) / 1000;
    const auto s = d.sample(u);
    EXPECT_GE(s.u_remapped, 0);
    EXPECT_LT(s.u_remapped, 1);
    EXPECT_NEAR(before[s.index] + s.u_remapped * s.pdf, u, 2 * 0x1p-24f);
  }
}

TEST(DiscreteDistribution, SingleEntryReturnsTheNumberUnchanged) {
  const auto s = DiscreteDistribution({4}).sample(0.375f);
  EXPECT_EQ(s.index, 0u);
  EXPECT_EQ(s.pdf, 1);
  EXPECT_EQ(s.u_remapped, 0.375f);
}

}  // namespace
}  // namespace kaustik
