#pragma once
// How many threads the process can keep busy: the machine's cores, its affinity mask and the CPU quota of its
// control groups, whichever is least.

#include <optional>
#include <string>
#include <string_view>

namespace kaustik::app {

// Cores that a cgroup v2 `cpu.max` grants: "150000 100000", microseconds of CPU time per period, is 1.5.
// Nothing for "max ...", which is no limit, and for text that is none.
std::optional<double> parse_cpu_max(std::string_view text);

struct CoreLimits {
  int hardware = 1;             // online in the machine
  int affinity = 1;             // that the calling thread may run on
  std::optional<double> quota;  // cores by cgroup v2 or v1: the least of the group's and its ancestors'

  // The least of them, at least 1. A part of a core counts as one: less would leave it idle.
  int usable() const;
};

// As they hold now. root: where /proc and /sys are looked for, for tests. A file that is missing sets no
// limit.
CoreLimits core_limits(const std::string& root = "");

}  // namespace kaustik::app
