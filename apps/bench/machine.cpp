#include "apps/bench/machine.h"

#include <fmt/format.h>
#include <hwy/highway.h>
#include <sys/utsname.h>
#include <tbb/version.h>
#include <unistd.h>

#include <fstream>

#include "accel/embree_version.h"
#include "apps/machine/usable_cores.h"
#include "render/picture/image_formats.h"

namespace kaustik::app {

namespace {

std::string first_line(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

Json cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return nullptr;
}

// Parses a size as the kernel writes it, such as "48K", into bytes.
uint64_t cache_bytes(const std::string& text) {
  uint64_t bytes = 0;
  for (const char c : text) {
    if (c >= '0' && c <= '9') bytes = 10 * bytes + static_cast<uint64_t>(c - '0');
    if (c == 'K') bytes <<= 10;
    if (c == 'M') bytes <<= 20;
  }
  return bytes;
}

Json caches() {
  Json out = Json::array();
  for (int i = 0;; ++i) {
    const std::string folder = fmt::format("/sys/devices/system/cpu/cpu0/cache/index{}/", i);
    const std::string level = first_line(folder + "level");
    if (level.empty()) return out;
    out.push_back({{"level", cache_bytes(level)},
                   {"type", first_line(folder + "type")},
                   {"bytes", cache_bytes(first_line(folder + "size"))},
                   {"shared_by_cpus", first_line(folder + "shared_cpu_list")}});
  }
}

// Highway calls AVX-512 with all that came with Skylake-X AVX3, and later additions AVX3_DL, AVX3_ZEN4 ...
std::string instruction_set_name(std::string target) {
  if (target.starts_with("AVX3")) target.replace(0, 4, "AVX-512");
  return target;
}

// The Highway targets that this machine supports, best first.
std::vector<std::string> highway_targets() {
  std::vector<std::string> names;
  for (const int64_t target : hwy::SupportedAndGeneratedTargets())
    names.push_back(instruction_set_name(hwy::TargetName(target)));
  return names;
}

// The version of OpenImageIO; null where the program has come without it.
Json image_library() {
  try {
    return render::image_formats().version();
  } catch (const std::exception&) {
    return nullptr;
  }
}

// Processors of each NUMA node, as the kernel writes them.
Json numa_nodes() {
  Json out = Json::array();
  for (int i = 0;; ++i) {
    const std::string cpus = first_line(fmt::format("/sys/devices/system/node/node{}/cpulist", i));
    if (cpus.empty()) return out;
    out.push_back(cpus);
  }
}

// The processors that this process may run on, as the kernel writes them: whoever pins threads sees it here.
Json allowed_cpus() {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("Cpus_allowed_list:")) return line.substr(line.find_first_not_of(" \t", 18));
  return nullptr;
}

Json cores() {
  const CoreLimits limits = core_limits();
  return {{"hardware", limits.hardware},
          {"affinity", limits.affinity},
          {"cgroup_quota", limits.quota ? Json(*limits.quota) : Json(nullptr)},
          {"usable", limits.usable()},
          {"allowed_cpus", allowed_cpus()},
          {"numa_nodes", numa_nodes()}};
}

Json libraries() {
  return {{"embree", accel::embree_version()},
          {"tbb", TBB_runtime_version()},
          {"openimageio", image_library()},
          {"highway", fmt::format("{}.{}.{}", HWY_MAJOR, HWY_MINOR, HWY_PATCH)},
          {"highway_targets", highway_targets()}};
}

}  // namespace

Json machine_json() {
  utsname system{};
  uname(&system);
  const std::vector<std::string> targets = highway_targets();
  Json out;
  out["cpu"] = cpu_model();
  out["architecture"] = system.machine;
  out["isa"] = targets.empty() ? Json(nullptr) : Json(targets.front());
  out["caches"] = caches();
  out["cores"] = cores();
  out["memory_bytes"] =
      static_cast<uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
  out["system"] = fmt::format("{} {}", system.sysname, system.release);
  out["compiler"] = __VERSION__;
  out["libraries"] = libraries();
  return out;
}

}  // namespace kaustik::app
