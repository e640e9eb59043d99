// Tests memory limits that are read from copies of the system's files.

#include "apps/machine/usable_memory.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

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
  uint64_t usable() const { return usable_memory(path("")).bytes; }
  std::string source() const { return usable_memory(path("")).source; }
  // The process holds `pages` pages, beside 100 of files.
  void hold(uint64_t pages) const {
    put("proc/self/statm", fmt::format("5000 {} 100 30 0 600 0\n", pages + 100));
  }
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

TEST_F(UsableMemory, HoldsWhatTheProcessHasAlready) {
  put("proc/meminfo", kMeminfo);
  hold(1000);
  const auto page = uint64_t(sysconf(_SC_PAGESIZE));
  EXPECT_EQ(held_memory(path("")), 1000 * page);
  EXPECT_EQ(usable(), 6000u * 1024 + 1000 * page);
  EXPECT_EQ(source(), "the memory of the machine");
}

// Of 50 MB the group takes 20: 5 are cached files, 4 this process's own, and the rest that of others.
TEST_F(UsableMemory, OthersInTheGroupTakeTheirPart) {
  put("proc/meminfo", "MemAvailable:   60000000 kB\n");
  put("proc/self/mountinfo", "30 23 0:26 / /sys/fs/cgroup rw,nosuid shared:4 - cgroup2 cgroup2 rw\n");
  put("proc/self/cgroup", "0::/\n");
  hold(4'000'000 / uint64_t(sysconf(_SC_PAGESIZE)));
  const uint64_t held = held_memory(path(""));
  put("sys/fs/cgroup/memory.max", "50000000\n");
  put("sys/fs/cgroup/memory.current", "20000000\n");
  put("sys/fs/cgroup/memory.stat", "anon 15000000\nfile 5000000\nfile_mapped 1000\n");
  EXPECT_EQ(usable(), 50'000'000u - (20'000'000u - 5'000'000u - held));
  EXPECT_EQ(source(), "the control group");
}

// The child has no files of its own in the folder but statm, so that only the limit counts.
TEST_F(UsableMemory, IsAtMostWhatUlimitLeaves) {
  hold(1000);
  EXPECT_EXIT(
      {
        rlimit limit{};
        limit.rlim_cur = limit.rlim_max = rlim_t{1} << 30;
        setrlimit(RLIMIT_AS, &limit);
        const MemoryLimit usable = usable_memory(path(""));
        // 5000 pages are less than what is reserved anyway, 2^28 bytes; 1000 of them are held.
        const auto page = uint64_t(sysconf(_SC_PAGESIZE));
        const bool right = usable.bytes == 3 * (uint64_t{1} << 28) + 1000 * page;
        std::_Exit(right && usable.source == "`ulimit -v`" ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace kaustik::app
