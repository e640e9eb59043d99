#include "tests/core/support/chi_square.h"

#include <gtest/gtest.h>

namespace kaustik::test {

void expect_all_accepted(const std::vector<SquareCase>& cases, int64_t samples, double mass_tolerance,
                         double least_mass) {
  const double significance = sidak_significance(cases.size());
  uint64_t seed = 1;
  for (const SquareCase& c : cases) {
    SCOPED_TRACE(c.name);
    const ChiSquareResult result = chi_square_test(c, samples, seed++);
    EXPECT_EQ(result.outside, 0);
    EXPECT_LE(result.expected_mass, 1 + mass_tolerance);
    EXPECT_GE(result.expected_mass, least_mass - mass_tolerance);
    EXPECT_GT(result.p_value, significance);
  }
}

}  // namespace kaustik::test
