#pragma once
// A parallel loop that can be cancelled.

#include <atomic>
#include <functional>
#include <thread>

#include "core/parallel/parallel.h"
#include "core/stopwatch.h"

namespace kaustik::parallel {

// Calls fn(i) for begin <= i < end as for_index() does, until go_on returns false: then some of the calls are
// left out, and the result is false. go_on, which may be empty, is called by this thread alone, before the
// loop and between its calls of fn, at intervals of 0.05 s or of one fn.
template <class Index, class Fn>
bool for_index_while(const std::function<bool()>& go_on, Index begin, Index end, const Fn& fn,
                     const Place& place = Place::current()) {
  constexpr double kInterval = 0.05;  // seconds
  if (go_on && !go_on()) return false;
  std::atomic<bool> cancelled = false;
  const std::thread::id caller = std::this_thread::get_id();
  Stopwatch since_asked;
  const auto ask_and_call = [&](Index i) {
    if (go_on && std::this_thread::get_id() == caller && since_asked.seconds() > kInterval) {
      if (!go_on()) cancelled = true;
      since_asked = {};
    }
    if (!cancelled.load(std::memory_order_relaxed)) fn(i);
  };
  for_index(begin, end, ask_and_call, Division::kAuto, place);
  return !cancelled;
}

}  // namespace kaustik::parallel
