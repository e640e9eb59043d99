#pragma once
// Parallel loops by oneTBB. They are those of oneTBB, and `kaustik bench --span` measures their tasks.
//
// None of them promises an order or a division: results must depend on neither.

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/parallel_reduce.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <source_location>

#include "core/parallel/work_span.h"

namespace kaustik::parallel {

using Place = std::source_location;

namespace detail {

// Tasks of a loop whose division is oneTBB's to choose: what it makes for a few hundred threads.
inline constexpr size_t kTasks = 1024;

class RecordedLoop {
 public:
  RecordedLoop(WorkSpanRecorder& recorder, const Place& place) : recorder_(recorder) {
    recorder_.begin_loop(place);
  }
  ~RecordedLoop() { recorder_.end_loop(); }
  template <class Fn>
  void task(const Fn& fn, bool in_order = false) {
    recorder_.begin_task();
    fn();
    recorder_.end_task(in_order);
  }

 private:
  WorkSpanRecorder& recorder_;
};

// Calls fn(begin, end) for parts, as tasks of a loop. most: tasks, where the loop leaves it open; otherwise
// each part has `grain` indices.
template <class Index, class Fn>
void recorded_parts(WorkSpanRecorder& recorder, const Place& place, Index begin, Index end, size_t grain,
                    size_t most, const Fn& fn) {
  RecordedLoop loop(recorder, place);
  const size_t count = begin < end ? size_t(end - begin) : 0;
  const size_t step = std::max(grain, count / most);
  for (size_t at = 0; at < count; at += step)
    loop.task([&] { fn(Index(begin + Index(at)), Index(begin + Index(std::min(at + step, count)))); });
}

}  // namespace detail

// Calls fn(i) for all begin <= i < end. each: every index is a task of its own, for few long ones.
enum class Division { kAuto, kEach };
template <class Index, class Fn>
void for_index(Index begin, Index end, const Fn& fn, Division division = Division::kAuto,
               const Place& place = Place::current()) {
  if (auto* recorder = WorkSpanRecorder::present()) {
    const size_t most = division == Division::kEach ? std::numeric_limits<size_t>::max() : detail::kTasks;
    return detail::recorded_parts(*recorder, place, begin, end, 1, most, [&](Index first, Index last) {
      for (Index i = first; i < last; ++i) fn(i);
    });
  }
  if (division == Division::kEach)
    tbb::parallel_for(begin, end, fn, tbb::simple_partitioner());
  else
    tbb::parallel_for(begin, end, fn);
}

// Calls fn(part) for parts of a range.
template <class Index, class Fn>
void for_range(const tbb::blocked_range<Index>& range, const Fn& fn, const Place& place = Place::current()) {
  if (auto* recorder = WorkSpanRecorder::present())
    return detail::recorded_parts(
        *recorder, place, range.begin(), range.end(), range.grainsize(), detail::kTasks,
        [&](Index first, Index last) { fn(tbb::blocked_range<Index>(first, last, range.grainsize())); });
  tbb::parallel_for(range, fn);
}

// The sum of fn(part, so far) by join(a, b).
template <class Index, class Value, class Fn, class Join>
Value reduce(const tbb::blocked_range<Index>& range, const Value& zero, const Fn& fn, const Join& join,
             const Place& place = Place::current()) {
  if (auto* recorder = WorkSpanRecorder::present()) {
    Value sum = zero;
    detail::recorded_parts(*recorder, place, range.begin(), range.end(), range.grainsize(), detail::kTasks,
                           [&](Index first, Index last) {
                             sum = fn(tbb::blocked_range<Index>(first, last, range.grainsize()), sum);
                           });
    return sum;
  }
  return tbb::parallel_reduce(range, zero, fn, join);
}

template <class First, class Second>
void invoke(const First& first, const Second& second, const Place& place = Place::current()) {
  if (auto* recorder = WorkSpanRecorder::present()) {
    detail::RecordedLoop loop(*recorder, place);
    loop.task(first), loop.task(second);
    return;
  }
  tbb::parallel_invoke(first, second);
}

template <class First, class Second, class Third>
void invoke(const First& first, const Second& second, const Third& third,
            const Place& place = Place::current()) {
  if (auto* recorder = WorkSpanRecorder::present()) {
    detail::RecordedLoop loop(*recorder, place);
    loop.task(first), loop.task(second), loop.task(third);
    return;
  }
  tbb::parallel_invoke(first, second, third);
}

template <class Iterator, class Less>
void sort(Iterator begin, Iterator end, const Less& less, const Place& place = Place::current()) {
  auto* const recorder = WorkSpanRecorder::present();
  if (!recorder) return tbb::parallel_sort(begin, end, less);
  detail::RecordedLoop loop(*recorder, place);
  loop.task([&] { tbb::parallel_sort(begin, end, less); });
  // A quicksort divides n, then n / 2 numbers, and so on, in one thread: 2 n of n log n steps.
  recorder->set_span_share(std::min(1.0, 2 / std::log2(double(end - begin) + 2)));
}
template <class Iterator>
void sort(Iterator begin, Iterator end, const Place& place = Place::current()) {
  sort(begin, end, std::less<>(), place);
}

// A pipeline of blocks, of which at most `most` are on their way: next(), in order, until it returns null;
// work(block); in_order(block), one after another in the order of next(); finish(block).
template <class Block, class Next, class Work, class InOrder, class Finish>
void pipeline(size_t most, const Next& next, const Work& work, const InOrder& in_order, const Finish& finish,
              const Place& place = Place::current()) {
  if (auto* recorder = WorkSpanRecorder::present()) {
    detail::RecordedLoop loop(*recorder, place);
    while (true) {
      Block* block = nullptr;
      loop.task([&] { block = next(); }, true);
      if (!block) return;
      loop.task([&] { work(block); });
      loop.task([&] { in_order(block); }, true);
      loop.task([&] { finish(block); });
    }
  }
  using tbb::filter_mode;
  tbb::parallel_pipeline(
      most, tbb::make_filter<void, Block*>(filter_mode::serial_in_order, [&](tbb::flow_control& control) {
              Block* const block = next();
              if (!block) control.stop();
              return block;
            }) & tbb::make_filter<Block*, Block*>(filter_mode::parallel, [&](Block* block) {
              work(block);
              return block;
            }) & tbb::make_filter<Block*, Block*>(filter_mode::serial_in_order, [&](Block* block) {
              in_order(block);
              return block;
            }) & tbb::make_filter<Block*, void>(filter_mode::parallel, finish));
}

}  // namespace kaustik::parallel
