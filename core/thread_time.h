#pragma once
// Processor time, which tells what work costs where others use the cores as well.

#include <ctime>

namespace kaustik {

// Processor time of the calling thread so far, in seconds.
inline double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

}  // namespace kaustik
