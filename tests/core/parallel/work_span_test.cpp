// Work and span of loops whose times are known, by a clock that the test moves.

#include "core/parallel/work_span.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <vector>

#include "core/parallel/parallel.h"

namespace kaustik {
namespace {

double now = 0;
double clock_of_test() {
  return now;
}

class WorkSpan : public ::testing::Test {
 protected:
  // What happens in a phase.
  template <class Fn>
  PhaseSpan phase(const Fn& fn) {
    now = 0;
    WorkSpanRecorder recorder(clock_of_test);
    const PhaseWatch watch;
    fn();
    watch.end("phase");
    return recorder.phases().at("phase");
  }
};

TEST_F(WorkSpan, TheLongestTaskOfALoopIsItsSpan) {
  const PhaseSpan found = phase([] {
    now += 3;
    parallel::for_index(1, 5, [](int i) { now += i; });
    now += 2;
  });
  EXPECT_EQ(found.seconds, 15);
  EXPECT_EQ(found.serial(), 5);
  EXPECT_EQ(found.span(), 9);
  EXPECT_DOUBLE_EQ(found.speed_up(2), 15 / (6 / 2.0 + 9));
  EXPECT_EQ(found.speed_up(1), 1);
}

TEST_F(WorkSpan, LoopsInATaskMakeItShorter) {
  const PhaseSpan found = phase([] {
    parallel::invoke([] { parallel::for_index(0, 10, [](int) { now += 1; }); },
                     [] {
                       now += 1;
                       parallel::for_index(0, 10, [](int) { now += 2; });
                       now += 1;
                     });
  });
  EXPECT_EQ(found.seconds, 32);
  EXPECT_EQ(found.span(), 4) << "two seconds in one thread and one of the inner tasks";
}

TEST_F(WorkSpan, WhatHappensInOrderAddsUp) {
  int next = 0, blocks[4] = {};
  std::vector<int> order;
  const PhaseSpan found = phase([&] {
    parallel::pipeline<int>(
        2, [&]() -> int* { return next < 4 ? &blocks[next++] : nullptr; }, [](int*) { now += 10; },
        [&](int* block) {
          now += 1;
          order.push_back(int(block - blocks));
        },
        [](int*) { now += 5; });
  });
  EXPECT_EQ(found.seconds, 4 * 16);
  EXPECT_EQ(found.span(), 4 * 1 + 10);
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3}));
}

TEST_F(WorkSpan, ManyShortTasksAreTakenTogether) {
  const PhaseSpan found = phase([] { parallel::for_index(0, 1 << 20, [](int) { now += 1; }); });
  EXPECT_EQ(found.seconds, 1 << 20);
  EXPECT_EQ(found.span(), 1 << 10);
  const PhaseSpan each = phase([] {
    parallel::for_index(
        0, 1 << 12, [](int) { now += 1; }, parallel::Division::kEach);
  });
  EXPECT_EQ(each.span(), 1) << "every index is a task, however many there are";
  const PhaseSpan grains = phase([] {
    parallel::for_range(tbb::blocked_range<int>(0, 100, 30),
                        [](const auto& range) { now += double(range.size()); });
  });
  EXPECT_EQ(grains.span(), 30);
}

TEST_F(WorkSpan, PhasesAndPlacesAddUp) {
  WorkSpanRecorder recorder(clock_of_test);
  for (int i = 0; i < 2; ++i) {
    const PhaseWatch watch;
    parallel::for_index(0, 4, [](int) { now += 1; });
    watch.end("twice");
    now += 7;  // in no phase
  }
  const PhaseSpan& found = recorder.phases().at("twice");
  EXPECT_EQ(found.seconds, 8);
  EXPECT_EQ(found.span(), 2);
  const auto loop =
      std::ranges::find_if(found.places, [](const auto& place) { return place.second.tasks > 0; });
  ASSERT_NE(loop, found.places.end());
  EXPECT_EQ(loop->second.tasks, 8u);
  EXPECT_NE(loop->first.find("work_span_test.cpp:"), std::string::npos);
}

// Recorded or not, loops do the same.
TEST(ParallelLoops, DoTheSameWhenTheyAreRecorded) {
  const auto results = [] {
    std::vector<int> numbers(5000);
    parallel::for_index(size_t{0}, numbers.size(), [&](size_t i) { numbers[i] = int(i * 7919 % 5003); });
    const long sum = parallel::reduce(
        tbb::blocked_range<size_t>(0, numbers.size()), 0L,
        [&](const auto& range, long so_far) {
          for (size_t i = range.begin(); i < range.end(); ++i) so_far += numbers[i];
          return so_far;
        },
        std::plus<>());
    std::vector<int> sorted = numbers;
    parallel::sort(sorted.begin(), sorted.end(), std::greater<>());
    std::vector<std::atomic<int>> visits(300);
    parallel::for_range(tbb::blocked_range<size_t>(0, visits.size(), 7), [&](const auto& range) {
      for (size_t i = range.begin(); i < range.end(); ++i) ++visits[i];
    });
    parallel::for_index(
        size_t{0}, visits.size(), [&](size_t i) { ++visits[i]; }, parallel::Division::kEach);
    EXPECT_TRUE(std::ranges::all_of(visits, [](const auto& n) { return n == 2; }));
    EXPECT_TRUE(std::ranges::is_sorted(sorted, std::greater<>()));
    EXPECT_EQ(sum, std::accumulate(numbers.begin(), numbers.end(), 0L));
    return sorted;
  };
  const auto alone = results();
  const WorkSpanRecorder recorder;
  EXPECT_EQ(results(), alone);
}

}  // namespace
}  // namespace kaustik
