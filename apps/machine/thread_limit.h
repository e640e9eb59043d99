#pragma once
// Keeps every thread of the process within a bound.

#include <functional>

namespace kaustik::app {

// Runs work in a task arena of at most `threads` threads, the caller's included; 0: as many as the process
// may use (core_limits). While it runs, oneTBB (and Embree, which uses it) makes no more workers than that,
// and the image library makes none.
void with_thread_limit(int threads, const std::function<void()>& work);

}  // namespace kaustik::app
