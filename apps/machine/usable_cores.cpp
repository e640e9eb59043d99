// CPU quotas are described in the kernel's cgroup-v2.rst ("CPU Interface Files") and, for v1, in
// sched-bwc.rst.

#include "apps/machine/usable_cores.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

#include "apps/command_line/values.h"
#include "apps/machine/control_groups.h"
#include "apps/machine/launched.h"

namespace kaustik::app {

namespace fs = std::filesystem;

namespace {

std::string first_line(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

std::optional<double> parse_quota(std::string_view quota, std::string_view period) {
  const std::optional<int64_t> q = parse_integer(quota), p = parse_integer(period);
  if (!q || !p || *q <= 0 || *p <= 0) return std::nullopt;  // v1 writes -1 for no limit
  return static_cast<double>(*q) / static_cast<double>(*p);
}

std::optional<double> quota_of(const fs::path& folder, CgroupVersion version) {
  if (version == CgroupVersion::kV2) return parse_cpu_max(first_line(folder / "cpu.max"));
  return parse_quota(first_line(folder / "cpu.cfs_quota_us"), first_line(folder / "cpu.cfs_period_us"));
}

std::optional<double> least_quota(const std::string& root) {
  std::optional<double> least;
  for (const CgroupVersion version : {CgroupVersion::kV1, CgroupVersion::kV2}) {
    for (const fs::path& folder : control_group_folders(version, "cpu", root)) {
      const std::optional<double> quota = quota_of(folder, version);
      if (quota) least = std::min(*quota, least.value_or(*quota));
    }
  }
  return least;
}

// A machine may have more cores than a cpu_set_t holds. The kernel then refuses the size, and the loop tries
// a larger one.
int cores_by_affinity(int otherwise) {
  for (int sets = 1; sets <= 64; sets *= 2) {
    std::vector<cpu_set_t> mask(static_cast<size_t>(sets));
    const size_t bytes = mask.size() * sizeof(cpu_set_t);
    if (sched_getaffinity(0, bytes, mask.data()) == 0) return CPU_COUNT_S(bytes, mask.data());
  }
  return otherwise;
}

}  // namespace

std::optional<double> parse_cpu_max(std::string_view text) {
  std::istringstream stream{std::string(text)};
  std::string quota, period, rest;
  if (!(stream >> quota >> period) || stream >> rest) return std::nullopt;
  return parse_quota(quota, period);
}

int CoreLimits::usable() const {
  int cores = std::min(hardware, affinity);
  if (quota && *quota < cores) cores = static_cast<int>(std::ceil(*quota));
  if (affinity >= hardware) cores /= ranks;
  return std::max(1, cores);
}

CoreLimits core_limits(const std::string& root) {
  CoreLimits limits;
  limits.hardware = static_cast<int>(std::max(1L, sysconf(_SC_NPROCESSORS_ONLN)));
  limits.affinity = cores_by_affinity(limits.hardware);
  limits.quota = least_quota(root);
  limits.ranks = launched().on_machine;
  return limits;
}

}  // namespace kaustik::app
