// Tests the Sobol sampler: stratification, determinism, padding, uniformity over seeds.

#include "core/sampling/sampler.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "tests/core/support/chi_square.h"
#include "tests/support/random.h"

namespace kaustik {
namespace {

// The value that Sampler draws in one dimension.
float sobol_owen(uint32_t index, uint64_t seed, uint32_t dimension) {
  return Sampler(seed, index, dimension).next_1d();
}

// Counts the points 0..2^m-1 (offset by `block` blocks) in the grid of elementary intervals with 2^bits[k]
// cells along dimension first + k.
std::vector<int> interval_counts(uint64_t seed, uint32_t first, const std::vector<int>& bits, int m,
                                 uint32_t block) {
  const int cells = std::accumulate(bits.begin(), bits.end(), 0);
  std::vector<int> counts(size_t{1} << cells, 0);
  for (uint32_t i = 0; i < (1u << m); ++i) {
    size_t cell = 0;
    for (size_t k = 0; k < bits.size(); ++k) {
      const float x = sobol_owen((block << m) + i, seed, first + static_cast<uint32_t>(k));
      cell = (cell << bits[k]) | static_cast<size_t>(x * static_cast<float>(1 << bits[k]));
    }
    ++counts[cell];
  }
  return counts;
}

void expect_equal_counts(const std::vector<int>& counts, int each) {
  for (const int c : counts) ASSERT_EQ(c, each);
}

// Owen scrambling keeps nets, and aligned blocks of a (0, 2)-sequence are (0, m, 2)-nets: they have one point
// in each elementary interval of volume 2^-m, whatever its shape.
TEST(Sampler, FirstTwoDimensionsOfEachSetAreZeroNets) {
  constexpr int kM = 8;
  for (const uint32_t first : {0u, 4u, 20u}) {
    for (const uint64_t seed : {0ull, 1ull, 0x123456789abcdefull}) {
      for (const uint32_t block : {0u, 5u, (1u << (32 - kM)) - 1}) {
        for (int a = 0; a <= kM; ++a)
          expect_equal_counts(interval_counts(seed, first, {a, kM - a}, kM, block), 1);
      }
    }
  }
}

TEST(Sampler, EveryDimensionIsStratified) {
  constexpr int kM = 10;
  for (uint32_t d = 0; d < 16; ++d) expect_equal_counts(interval_counts(7, d, {kM}, kM, 0), 1);
}

// Sobol's bound: t is the sum of (degree - 1) over the primitive polynomials, 0 + 0 + 1 + 2 = 3 in four
// dimensions.
TEST(Sampler, WholeSetIsNetOfQualityThree) {
  constexpr int kM = 9, kT = 3;
  for (int a = 0; a <= kM - kT; ++a) {
    for (int b = 0; a + b <= kM - kT; ++b) {
      for (int c = 0; a + b + c <= kM - kT; ++c) {
        expect_equal_counts(interval_counts(11, 4, {a, b, c, kM - kT - a - b - c}, kM, 2), 1 << kT);
      }
    }
  }
}

TEST(Sampler, IsPureFunctionOfSeedIndexDimension) {
  Sampler a(42, 1000);
  std::vector<float> drawn;
  for (int i = 0; i < 12; ++i) drawn.push_back(a.next_1d());
  for (uint32_t d = 0; d < 12; ++d) {
    EXPECT_EQ(sobol_owen(1000, 42, d), drawn[d]);
    EXPECT_EQ(Sampler(42, 1000, d).next_1d(), drawn[d]);
  }
}

TEST(Sampler, PairsAreAlignedToOneSet) {
  Sampler s(3, 17);
  const float first = s.next_1d();
  const Point2 pair = s.next_2d();
  EXPECT_EQ(s.dimension(), 4u);
  EXPECT_EQ(first, sobol_owen(17, 3, 0));
  EXPECT_EQ(pair.x, sobol_owen(17, 3, 2));
  EXPECT_EQ(pair.y, sobol_owen(17, 3, 3));
}

TEST(Sampler, IndicesAboveThirtyTwoBitsAreOtherSequences) {
  int equal = 0;
  for (uint64_t i = 0; i < 1000; ++i) {
    equal += Sampler(1, i).next_1d() == Sampler(1, i + (1ull << 32)).next_1d();
  }
  // Values have 24 bits, so the chance of even two accidental matches in 1000 is below 1e-8.
  EXPECT_LE(equal, 1);
}

TEST(Sampler, ValuesStayBelowOne) {
  for (uint32_t i = 0; i < 100000; ++i) {
    const float x = sobol_owen(i * 42949u, 9, i % 8);
    ASSERT_GE(x, 0);
    ASSERT_LT(x, 1);
  }
}

// A fixed index must be uniform over many seeds, and uncorrelated between dimensions: that makes every
// estimate unbiased.
TEST(Sampler, IsUniformOverSeeds) {
  std::vector<test::SquareCase> cases;
  for (const auto& [d0, d1] : {std::pair{0u, 1u}, {2u, 3u}, {1u, 2u}, {3u, 4u}, {0u, 8u}}) {
    for (const uint32_t index : {0u, 1u, 0xffffffffu}) {
      cases.push_back({"dimensions " + std::to_string(d0) + "," + std::to_string(d1), nullptr,
                       [](double, double) { return 1.0; }});
      cases.back().sample = [=, seed = uint64_t{0}](test::Random&, Point2* p) mutable {
        *p = {sobol_owen(index, seed, d0), sobol_owen(index, seed, d1)};
        ++seed;
        return true;
      };
    }
  }
  test::expect_all_accepted(cases, 100000, 1e-9);
}

}  // namespace
}  // namespace kaustik
