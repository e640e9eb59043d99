#pragma once
// How much memory the process can take before the system swaps or kills it.

#include <cstdint>
#include <string>

namespace kaustik::app {

// In bytes, the minimum of the kernel's estimate (MemAvailable of /proc/meminfo, without swap) and the limits
// of the process's control groups. `root`: a prefix of /proc and /sys, for tests. A missing file sets no
// limit; without any limit, the largest uint64_t.
uint64_t usable_memory(const std::string& root = "");

}  // namespace kaustik::app
