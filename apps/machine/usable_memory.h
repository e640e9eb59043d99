#pragma once
// How much memory the process can take before the machine swaps or ends it.

#include <cstdint>
#include <string>

namespace kaustik::app {

// Bytes: what the kernel holds to be available (MemAvailable of /proc/meminfo, no swap), or the least limit
// of the process's control groups where that is less. root: where /proc and /sys are looked for, for tests. A
// file that is missing sets no limit; without any, the largest number.
uint64_t usable_memory(const std::string& root = "");

}  // namespace kaustik::app
