// The time left, with a clock of the test's own.

#include "apps/console/time_left.h"

#include <gtest/gtest.h>

namespace kaustik::app {
namespace {

// A render of `passes` passes, each of which shoots photons for 3 s and renders for 9 s.
TimeLeft::Estimate after(TimeLeft* left, double seconds, uint64_t passes) {
  const uint64_t pass = uint64_t(seconds / 12);
  const double in_pass = seconds - 12 * double(pass);
  return in_pass < 3 ? left->update({"photons", uint64_t(100 * in_pass), 300, pass, passes}, seconds)
                     : left->update({"render", uint64_t(100 * (in_pass - 3)), 900, pass, passes}, seconds);
}

TEST(TimeLeft, CountsToTheEndOfAllPhasesAndPasses) {
  TimeLeft left;
  double fraction = 0;
  for (double seconds = 0; seconds < 48; seconds += 0.25) {
    const TimeLeft::Estimate estimate = after(&left, seconds, 4);
    EXPECT_GE(estimate.fraction, fraction) << "at " << seconds << " s";
    fraction = estimate.fraction;
    if (seconds < 3.5) continue;  // photons were taken for half of the work until rendering has begun
    ASSERT_TRUE(estimate.seconds);
    EXPECT_NEAR(*estimate.seconds, 48 - seconds, 0.01 * 48) << "at " << seconds << " s";
  }
  EXPECT_NEAR(fraction, 47.75 / 48, 0.01);
}

// Until rendering has begun, the estimate is that of the same time for photons and for rendering.
TEST(TimeLeft, DoesNotRestartWithAPhase) {
  TimeLeft left;
  after(&left, 0, 1);
  EXPECT_NEAR(*after(&left, 1.5, 1).seconds, 4.5, 1e-9);
  EXPECT_NEAR(*after(&left, 2.99, 1).seconds, 3, 0.1);
  EXPECT_NEAR(*after(&left, 3, 1).seconds, 3, 1e-9);
  EXPECT_NEAR(*after(&left, 6, 1).seconds, 6, 1e-9);
}

TEST(TimeLeft, EndsAtTheDeadline) {
  TimeLeft left;
  left.set_deadline(20);
  EXPECT_EQ(*after(&left, 0, 0).seconds, 20);
  EXPECT_EQ(*after(&left, 5, 0).seconds, 15);
  EXPECT_EQ(after(&left, 10, 0).fraction, 0.5);
  EXPECT_EQ(*after(&left, 25, 0).seconds, 0);
}

TEST(TimeLeft, IsUnknownWithoutAnEnd) {
  TimeLeft left;
  for (double seconds = 0; seconds < 18; seconds += 0.25) EXPECT_FALSE(after(&left, seconds, 0).seconds);
  left.set_end(4);
  EXPECT_NEAR(*after(&left, 18, 0).seconds, 30, 1e-9);
  left.set_end(1);  // the target was nearer than thought: this pass is the last
  EXPECT_FALSE(after(&left, 19, 0).seconds);
}

// A range of passes is no longer than its passes.
TEST(TimeLeft, CountsFromTheFirstPassOfARange) {
  TimeLeft left;
  left.set_end(8);
  for (uint64_t tenth = 0; tenth <= 10; ++tenth) left.update({"render", tenth, 10, 6, 12}, double(tenth));
  EXPECT_NEAR(*left.update({"render", 0, 10, 7, 12}, 10.0).seconds, 10, 1e-9);
}

}  // namespace
}  // namespace kaustik::app
