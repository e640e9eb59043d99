#include "core/parallel/cancellable.h"

#include <gtest/gtest.h>

#include <chrono>
#include <vector>

namespace kaustik::parallel {
namespace {

TEST(ForIndexWhile, CallsForEveryIndexOnce) {
  for (const std::function<bool()>& go_on :
       {std::function<bool()>(), std::function<bool()>([] { return true; })}) {
    std::vector<std::atomic<int>> calls(1000);
    EXPECT_TRUE(for_index_while(go_on, size_t{0}, calls.size(), [&](size_t i) { ++calls[i]; }));
    for (const std::atomic<int>& count : calls) EXPECT_EQ(count, 1);
  }
}

// Calls that take longer than the interval: go_on is asked before each of this thread, and by no other.
TEST(ForIndexWhile, EndsEarlyWhenItMayNotGoOn) {
  std::atomic<int> calls = 0;
  const auto slow = [&](size_t) {
    ++calls;
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
  };
  EXPECT_FALSE(for_index_while([] { return false; }, size_t{0}, size_t{1000}, slow));
  EXPECT_EQ(calls, 0);
  const std::thread::id caller = std::this_thread::get_id();
  int asked = 0;
  const auto go_on = [&] {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    return ++asked < 3;
  };
  EXPECT_FALSE(for_index_while(go_on, size_t{0}, size_t{1000}, slow));
  EXPECT_EQ(asked, 3);
  EXPECT_LT(calls, 1000);
}

}  // namespace
}  // namespace kaustik::parallel
