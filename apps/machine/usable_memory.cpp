// Memory limits are described in the kernel's cgroup-v2.rst ("Memory Interface Files") and, for v1, in
// memory.txt.

#include "apps/machine/usable_memory.h"

#include <algorithm>
#include <fstream>
#include <limits>

#include "apps/machine/control_groups.h"
#include "apps/machine/launched.h"

namespace kaustik::app {

namespace {

constexpr uint64_t kNoLimit = std::numeric_limits<uint64_t>::max();

// Reads the line "MemAvailable:   22243596 kB" of /proc/meminfo; bytes.
uint64_t available_in_machine(const std::string& root) {
  std::ifstream file(root + "/proc/meminfo");
  std::string name, unit;
  for (uint64_t kilobytes = 0; file >> name >> kilobytes; std::getline(file, unit))
    if (name == "MemAvailable:") return kilobytes * 1024;
  return kNoLimit;
}

// The file holds one number. For no limit, v2 writes "max" and v1 a number near 2^63.
uint64_t limit_in(const std::filesystem::path& path) {
  std::ifstream file(path);
  uint64_t bytes = 0;
  return file >> bytes ? bytes : kNoLimit;
}

uint64_t least_limit(CgroupVersion version, const char* file, const std::string& root) {
  uint64_t least = kNoLimit;
  for (const auto& folder : control_group_folders(version, "memory", root))
    least = std::min(least, limit_in(folder / file));
  return least;
}

}  // namespace

uint64_t usable_memory(const std::string& root) {
  const uint64_t bytes =
      std::min({available_in_machine(root), least_limit(CgroupVersion::kV2, "memory.max", root),
                least_limit(CgroupVersion::kV1, "memory.limit_in_bytes", root)});
  return bytes / uint64_t(launched().on_machine);
}

}  // namespace kaustik::app
