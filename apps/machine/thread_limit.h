#pragma once
// Limits the number of threads of the process.

#include <functional>

#include "apps/console/console.h"

namespace kaustik::app {

// How many of `wanted` threads the process can run at once, including the caller's: less where the system
// limits the user's processes, the control group's tasks or the address space. It starts them once to find
// out, since oneTBB ends the process when it cannot start a worker.
int startable_threads(int wanted);

// A render of more threads than this only takes longer: four on each core, and 64 on few cores, so that tests
// and demonstrations of equal results for any number are possible.
int most_useful_threads(int cores);

// The threads that a command runs on when `threads` are asked for; 0 = as many as the process may use
// (core_limits). Fewer, with a warning, if that is more than most_useful_threads() or more than can be
// started.
int threads_to_run(int threads, const Console& console);

// Runs `work` in a task arena of at most `threads` threads, including the caller's. Meanwhile oneTBB, which
// Embree uses too, creates no more workers than that.
void with_thread_limit(int threads, const std::function<void()>& work);

// The same for threads_to_run().
void with_thread_limit(int threads, const Console& console, const std::function<void()>& work);

}  // namespace kaustik::app
