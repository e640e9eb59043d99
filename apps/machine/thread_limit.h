#pragma once
// Limits the number of threads of the process.

#include <functional>

namespace kaustik::app {

// Runs `work` in a task arena of at most `threads` threads, including the caller's; 0 = as many as the
// process may use (core_limits). Meanwhile oneTBB, which Embree uses too, creates no more workers than that.
void with_thread_limit(int threads, const std::function<void()>& work);

}  // namespace kaustik::app
