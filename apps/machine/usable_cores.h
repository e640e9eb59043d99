#pragma once
// How many threads the process can keep busy: the minimum of the machine's cores, the process's affinity mask
// and the CPU quota of its control groups, shared with other ranks.

#include <optional>
#include <string>
#include <string_view>

namespace kaustik::app {

// The cores that a cgroup v2 file `cpu.max` grants. It holds microseconds of CPU time and of the period:
// "150000 100000" is 1.5 cores. Nothing for "max ...", which is no limit, and for malformed text.
std::optional<double> parse_cpu_max(std::string_view text);

struct CoreLimits {
  int hardware = 1;             // online in the machine
  int affinity = 1;             // the calling thread may run on
  std::optional<double> quota;  // the least quota of the cgroup (v2 or v1) and its ancestors, in cores

  int ranks = 1;  // processes of the same render on this machine (launched())

  // The least of the three, at least 1. A fraction of a core counts as a whole one, so that it is not left
  // idle. Ranks that no launcher has bound to cores of their own share them.
  int usable() const;
};

// The limits that hold now. `root`: a prefix of /proc and /sys, for tests. A missing file sets no limit.
CoreLimits core_limits(const std::string& root = "");

}  // namespace kaustik::app
