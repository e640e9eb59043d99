#pragma once
// How much memory the process can hold before the system swaps, refuses or kills it.

#include <cstdint>
#include <string>

#include "core/memory/process_memory.h"

namespace kaustik::app {

struct MemoryLimit {
  uint64_t bytes;      // of what the process holds itself, see held_memory(); the largest uint64_t: no limit
  std::string source;  // what sets it, for messages: "the control group"
};

// The least of what the machine has available (MemAvailable of /proc/meminfo, without swap), of the limits of
// the process's control groups, and of those that `ulimit -v` and `ulimit -d` set. Each is what others leave
// to this process, together with what it holds already. Ranks that a launcher has started on this machine
// share it equally. `root`: a prefix of /proc and /sys, for tests. A missing file sets no limit.
MemoryLimit usable_memory(const std::string& root = "");

}  // namespace kaustik::app
