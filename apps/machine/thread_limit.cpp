#include "apps/machine/thread_limit.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "apps/machine/usable_cores.h"

namespace kaustik::app {

namespace {

// Starts this many threads, all of which live until the last one is started. Returns how many there were.
int started_at_once(int wanted) {
  std::atomic<bool> go = false;
  std::vector<std::thread> threads;
  threads.reserve(static_cast<size_t>(wanted));
  try {
    while (static_cast<int>(threads.size()) < wanted) threads.emplace_back([&go] { go.wait(false); });
  } catch (const std::system_error&) {
    // The system allows no more.
  }
  go = true;
  go.notify_all();
  for (std::thread& thread : threads) thread.join();
  return static_cast<int>(threads.size());
}

}  // namespace

int startable_threads(int wanted) {
  static std::mutex mutex;
  static int known = 1;         // threads that could be started
  static bool is_most = false;  // one more could not
  const std::lock_guard lock(mutex);
  if (wanted > known && !is_most) {
    known = std::max(known, 1 + started_at_once(wanted - 1));
    is_most = known < wanted;
  }
  return std::min(wanted, known);
}

int most_useful_threads(int cores) {
  return std::max(64, 4 * cores);
}

int threads_to_run(int threads, const Console& console) {
  static std::atomic<bool> warned = false;
  const int cores = core_limits().usable();
  const int asked = threads > 0 ? threads : cores;
  const int wanted = std::min(asked, most_useful_threads(cores));
  if (wanted < asked && !warned.exchange(true))
    console.warning(fmt::format("{} threads are used: of {} most would wait for one of the {} cores", wanted,
                                asked, cores));
  const int possible = startable_threads(wanted);
  if (possible < wanted && !warned.exchange(true))
    console.warning(fmt::format("the system lets this process run {} of {} threads", possible, wanted));
  return possible;
}

void with_thread_limit(int threads, const std::function<void()>& work) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                    static_cast<size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute(work);
}

void with_thread_limit(int threads, const Console& console, const std::function<void()>& work) {
  with_thread_limit(threads_to_run(threads, console), work);
}

}  // namespace kaustik::app
