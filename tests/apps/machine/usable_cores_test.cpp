// Tests the number of usable cores by affinity and by control groups; the groups are files in the test's own
// folder.

#include <sched.h>
#include <tbb/task_arena.h>

#include <sstream>

#include "apps/machine/thread_limit.h"
#include "apps/machine/usable_cores.h"
#include "tests/apps/support/program.h"

namespace kaustik::app {
namespace {

TEST(ParseCpuMax, IsQuotaOverPeriod) {
  EXPECT_EQ(parse_cpu_max("200000 100000\n"), 2.0);
  EXPECT_EQ(parse_cpu_max("150000 100000"), 1.5);
  EXPECT_EQ(parse_cpu_max("1000 1000000"), 0.001);
}

TEST(ParseCpuMax, MaxAndMalformedTextSetNoLimit) {
  for (const char* text :
       {"max 100000\n", "max", "", "\n", "100000", "0 100000", "-1 100000", "100000 0", "100000 -5",
        "abc 100000", "100000 abc", "1e5 100000", "100000 100000 7", "99999999999999999999 100000"}) {
    EXPECT_EQ(parse_cpu_max(text), std::nullopt) << text;
  }
}

TEST(CoreLimits, LowestLimitAppliesAndFractionsRoundUp) {
  EXPECT_EQ((CoreLimits{8, 8, std::nullopt}).usable(), 8);
  EXPECT_EQ((CoreLimits{8, 3, std::nullopt}).usable(), 3);
  EXPECT_EQ((CoreLimits{8, 8, 2.0}).usable(), 2);
  EXPECT_EQ((CoreLimits{8, 8, 2.5}).usable(), 3);
  EXPECT_EQ((CoreLimits{8, 2, 6.0}).usable(), 2);
  EXPECT_EQ((CoreLimits{8, 8, 0.01}).usable(), 1);
  EXPECT_EQ((CoreLimits{8, 8, 1e18}).usable(), 8);
}

// A tree of files that stands for / of a machine.
class CgroupTest : public test::ProgramTest {
 protected:
  void put(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(std::filesystem::path(path(name)).parent_path());
    write(name, text);
  }
  void mount(const std::string& lines) const { put("proc/self/mountinfo", lines); }
  void group(const std::string& lines) const { put("proc/self/cgroup", lines); }
  std::optional<double> quota() const {
    std::string root = path("");
    root.pop_back();  // removes the slash
    return core_limits(root).quota;
  }

  static constexpr const char* kV2Mount =
      "20 1 8:1 / / rw - ext4 /dev/sda1 rw\n"
      "31 20 0:26 / /sys/fs/cgroup rw,nosuid shared:9 - cgroup2 cgroup2 rw,nsdelegate\n";
};

TEST_F(CgroupTest, MissingFilesSetNoLimit) {
  EXPECT_EQ(quota(), std::nullopt);
  mount(kV2Mount);
  group("0::/\n");
  EXPECT_EQ(quota(), std::nullopt);
}

TEST_F(CgroupTest, LimitsOfAncestorsApply) {
  mount(kV2Mount);
  group("0::/farm.slice/job.scope\n");
  put("sys/fs/cgroup/farm.slice/job.scope/cpu.max", "800000 100000\n");
  EXPECT_EQ(quota(), 8.0);
  put("sys/fs/cgroup/farm.slice/cpu.max", "350000 100000\n");
  EXPECT_EQ(quota(), 3.5);
  put("sys/fs/cgroup/farm.slice/cpu.max", "max 100000\n");
  EXPECT_EQ(quota(), 8.0);
}

// In a container with a namespace of its own, the group is the mount's root.
TEST_F(CgroupTest, RootOfAContainerIsRead) {
  mount(kV2Mount);
  group("0::/\n");
  put("sys/fs/cgroup/cpu.max", "250000 100000\n");
  EXPECT_EQ(quota(), 2.5);
}

// Without a namespace the process sees its host's path while only its own group is mounted.
TEST_F(CgroupTest, PathsAreRelativeToTheMountsRoot) {
  mount("31 20 0:26 /docker/abc /sys/fs/cgroup rw - cgroup2 cgroup rw\n");
  group("0::/docker/abc/inner\n");
  put("sys/fs/cgroup/cpu.max", "400000 100000\n");
  EXPECT_EQ(quota(), 4.0);
  put("sys/fs/cgroup/inner/cpu.max", "100000 100000\n");
  EXPECT_EQ(quota(), 1.0);
}

TEST_F(CgroupTest, GroupOutsideTheMountDoesNotLeaveIt) {
  mount(kV2Mount);
  group("0::/../other\n");
  put("sys/fs/other/cpu.max", "100000 100000\n");
  EXPECT_EQ(quota(), std::nullopt);
}

TEST_F(CgroupTest, VersionOneIsRead) {
  mount(
      "31 20 0:26 / /sys/fs/cgroup/cpu,cpuacct rw shared:3 - cgroup cgroup rw,cpu,cpuacct\n"
      "32 20 0:27 / /sys/fs/cgroup/cpuset rw - cgroup cgroup rw,cpuset\n");
  group("5:cpuset:/wrong\n4:cpu,cpuacct:/job\n0::/elsewhere\n");
  put("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_quota_us", "-1\n");
  put("sys/fs/cgroup/cpu,cpuacct/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(quota(), std::nullopt);
  put("sys/fs/cgroup/cpu,cpuacct/job/cpu.cfs_quota_us", "150000\n");
  put("sys/fs/cgroup/cpu,cpuacct/job/cpu.cfs_period_us", "50000\n");
  EXPECT_EQ(quota(), 3.0);
}

// Keeps the calling thread on its first core while it lives.
class OneCore {
 public:
  OneCore() {
    sched_getaffinity(0, sizeof before_, &before_);
    cpu_set_t one;
    CPU_ZERO(&one);
    for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++cpu)
      if (CPU_ISSET(cpu, &before_)) CPU_SET(cpu, &one);
    sched_setaffinity(0, sizeof one, &one);
  }
  ~OneCore() { sched_setaffinity(0, sizeof before_, &before_); }
  OneCore(const OneCore&) = delete;
  OneCore& operator=(const OneCore&) = delete;

 private:
  cpu_set_t before_;
};

TEST(UsableCores, AffinityLimitsTheDefaultThreads) {
  const OneCore one;
  EXPECT_EQ(core_limits().affinity, 1);
  int concurrency = 0;
  std::ostringstream text;
  with_thread_limit(0, Console{text, text}, [&] { concurrency = tbb::this_task_arena::max_concurrency(); });
  EXPECT_EQ(concurrency, 1);
  EXPECT_EQ(text.str(), "");
  with_thread_limit(3, [&] { concurrency = tbb::this_task_arena::max_concurrency(); });
  EXPECT_EQ(concurrency, 3);
}

}  // namespace
}  // namespace kaustik::app
