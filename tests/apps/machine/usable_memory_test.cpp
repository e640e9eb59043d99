// Tests memory limits that are read from copies of the system's files.

#include "apps/machine/usable_memory.h"

#include <limits>

#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

class UsableMemory : public test::ProgramTest {
 protected:
  void put(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
    write(name, text);
  }
  uint64_t usable() const { return usable_memory(path("")); }
};

constexpr const char* kMeminfo =
    "MemTotal:       8000 kB\nMemFree:        1000 kB\nMemAvailable:   6000 kB\n";

TEST_F(UsableMemory, IsTheKernelsEstimateOfAvailableMemory) {
  put("proc/meminfo", kMeminfo);
  EXPECT_EQ(usable(), 6000u * 1024);
}

TEST_F(UsableMemory, HasNoLimitWithoutFiles) {
  EXPECT_EQ(usable(), std::numeric_limits<uint64_t>::max());
}

TEST_F(UsableMemory, IsAtMostTheLimitsOfTheGroupAndItsAncestors) {
  put("proc/meminfo", kMeminfo);
  put("proc/self/mountinfo", "30 23 0:26 / /sys/fs/cgroup rw,nosuid shared:4 - cgroup2 cgroup2 rw\n");
  put("proc/self/cgroup", "0::/user.slice/session.scope\n");
  put("sys/fs/cgroup/user.slice/session.scope/memory.max", "max\n");
  EXPECT_EQ(usable(), 6000u * 1024);
  put("sys/fs/cgroup/user.slice/session.scope/memory.max", "5000000\n");
  EXPECT_EQ(usable(), 5000000u);
  put("sys/fs/cgroup/user.slice/memory.max", "3000000\n");
  EXPECT_EQ(usable(), 3000000u);
}

TEST_F(UsableMemory, VersionOneHasAHierarchyOfItsOwn) {
  put("proc/meminfo", kMeminfo);
  put("proc/self/mountinfo",
      "31 23 0:27 / /sys/fs/cgroup/memory rw,nosuid shared:5 - cgroup cgroup rw,memory\n");
  put("proc/self/cgroup", "4:memory:/docker\n");
  put("sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");  // no limit
  EXPECT_EQ(usable(), 6000u * 1024);
  put("sys/fs/cgroup/memory/docker/memory.limit_in_bytes", "2000000\n");
  EXPECT_EQ(usable(), 2000000u);
}

}  // namespace
}  // namespace kaustik::app
