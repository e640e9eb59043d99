// Memory limits are described in the kernel's cgroup-v2.rst ("Memory Interface Files") and, for v1, in
// memory.txt; meminfo in proc(5).

#include "apps/machine/usable_memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

#include "apps/machine/control_groups.h"
#include "apps/machine/launched.h"

namespace kaustik::app {

namespace {

constexpr uint64_t kNoLimit = std::numeric_limits<uint64_t>::max();

// Address space that libraries, threads and the arenas of the C library have reserved at the least once a
// render has begun, mostly without touching it; and data of it. Measured: renders of small scenes, of which
// they hold 15 MB, end well under `ulimit -v 300000` and under `ulimit -d 200000`.
constexpr uint64_t kReservedSpace = uint64_t{256} << 20, kReservedData = uint64_t{64} << 20;

uint64_t sum_or_most(uint64_t a, uint64_t b) {
  return a > kNoLimit - b ? kNoLimit : a + b;
}

uint64_t difference_or_0(uint64_t a, uint64_t b) {
  return a - std::min(a, b);
}

// Reads the number on the line of this name, such as "MemAvailable:   22243596 kB" or "file 4096".
uint64_t number_named(const std::filesystem::path& path, const std::string& name, uint64_t otherwise) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    uint64_t number = 0;
    if (words >> word >> number && word == name) return number;
  }
  return otherwise;
}

uint64_t available_in_machine(const std::string& root) {
  const uint64_t kilobytes = number_named(root + "/proc/meminfo", "MemAvailable:", kNoLimit);
  return kilobytes == kNoLimit ? kNoLimit : kilobytes * 1024;
}

// The file holds one number. For no limit, v2 writes "max" and v1 a number near 2^63.
constexpr uint64_t kAsGoodAsNone = uint64_t{1} << 62;
uint64_t number_in(const std::filesystem::path& path, uint64_t otherwise) {
  std::ifstream file(path);
  uint64_t bytes = 0;
  return file >> bytes ? bytes : otherwise;
}

// The files of a memory controller: its limit, what its group takes, and the cached pages of files in
// memory.stat, which, like reclaimable slabs, the kernel drops before it kills anyone.
struct GroupFiles {
  CgroupVersion version;
  const char *limit, *usage, *cached;
};
constexpr GroupFiles kVersion2{CgroupVersion::kV2, "memory.max", "memory.current", "file"};
constexpr GroupFiles kVersion1{CgroupVersion::kV1, "memory.limit_in_bytes", "memory.usage_in_bytes",
                               "total_cache"};

// The least that any group leaves this process, which holds `held` bytes.
uint64_t left_by_groups(const GroupFiles& files, uint64_t held, const std::string& root) {
  uint64_t least = kNoLimit;
  for (const auto& folder : control_group_folders(files.version, "memory", root)) {
    const uint64_t limit = number_in(folder / files.limit, kNoLimit);
    if (limit >= kAsGoodAsNone) continue;
    const uint64_t usage = number_in(folder / files.usage, 0);
    const uint64_t cached = number_named(folder / "memory.stat", files.cached, 0) +
                            number_named(folder / "memory.stat", "slab_reclaimable", 0);
    const uint64_t of_others = difference_or_0(usage, cached + held);
    least = std::min(least, difference_or_0(limit, of_others));
  }
  return least;
}

// What setrlimit(2) leaves of a resource of which the process has taken this much. reserved: what it will
// have taken without use for it, at the least.
uint64_t left_by_system(decltype(RLIMIT_AS) resource, uint64_t taken, uint64_t reserved, uint64_t held) {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kNoLimit;
  return sum_or_most(held, difference_or_0(limit.rlim_cur, std::max(taken, reserved)));
}

// The part of one of several ranks, of what is left to all of them with what this one holds.
uint64_t share(uint64_t left, uint64_t held, uint64_t ranks) {
  return left == kNoLimit ? left : held + difference_or_0(left, held) / ranks;
}

}  // namespace

MemoryLimit usable_memory(const std::string& root) {
  const ProcessMemory own = process_memory(root);
  const uint64_t held = held_memory(root), ranks = uint64_t(launched().on_machine);
  const MemoryLimit limits[] = {
      {share(sum_or_most(held, available_in_machine(root)), held, ranks), "the memory of the machine"},
      {share(left_by_groups(kVersion2, held, root), held, ranks), "the control group"},
      {share(left_by_groups(kVersion1, held, root), held, ranks), "the control group"},
      {left_by_system(RLIMIT_AS, own.mapped, kReservedSpace, held), "`ulimit -v`"},
      {left_by_system(RLIMIT_DATA, own.data, kReservedData, held), "`ulimit -d`"}};
  return *std::min_element(std::begin(limits), std::end(limits),
                           [](const auto& a, const auto& b) { return a.bytes < b.bytes; });
}

}  // namespace kaustik::app
