// What those who follow a render are told of it.

#include "apps/live/live_render.h"

#include <gtest/gtest.h>

namespace kaustik::app {
namespace {

// A render may have millions of passes.
TEST(LiveRender, KeepsAsManyErrorsAsACurveNeeds) {
  LiveRender live("room", {0, 4, 0, 4}, 4, 4);
  for (uint64_t pass = 2; pass < 20'000; ++pass) live.tell_error(pass, 1 / double(pass));
  const std::vector<ErrorPoint> errors = live.status().errors;
  EXPECT_LE(errors.size(), 400u);
  EXPECT_GE(errors.size(), 200u);
  EXPECT_EQ(errors.front().passes, 2u);
  EXPECT_EQ(errors.back().passes, 19'999u);
  for (size_t i = 1; i < errors.size(); ++i) EXPECT_LT(errors[i - 1].passes, errors[i].passes);
}

TEST(LiveRender, SaysWhyThereIsNoPicture) {
  LiveRender live("room", {0, 4, 0, 4}, 4, 4);
  live.finish("no memory");
  EXPECT_EQ(live.status().state, LiveState::kFinished);
  EXPECT_EQ(live.status().trouble, "no memory");
}

}  // namespace
}  // namespace kaustik::app
