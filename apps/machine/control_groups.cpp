#include "apps/machine/control_groups.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>

namespace kaustik::app {

namespace fs = std::filesystem;

namespace {

// Whether `name` is one of the comma-separated `names`.
bool has_name(const std::string& names, std::string_view name) {
  std::istringstream stream(names);
  for (std::string part; std::getline(stream, part, ',');)
    if (part == name) return true;
  return false;
}

// Where a hierarchy is mounted: its group `root` appears at the folder `point`.
struct Mount {
  std::string root, point;
};

// Searches /proc/self/mountinfo, whose lines are "31 23 0:28 ROOT POINT options [tags] - TYPE source
// SUPER_OPTIONS".
std::optional<Mount> find_mount(CgroupVersion version, std::string_view controller, const std::string& root) {
  std::ifstream file(root + "/proc/self/mountinfo");
  for (std::string line; std::getline(file, line);) {
    const size_t dash = line.find(" - ");
    if (dash == std::string::npos) continue;
    std::istringstream left(line.substr(0, dash)), right(line.substr(dash + 3));
    std::string skipped, type, source, options;
    Mount mount;
    left >> skipped >> skipped >> skipped >> mount.root >> mount.point;
    right >> type >> source >> options;
    const bool found =
        version == CgroupVersion::kV2 ? type == "cgroup2" : type == "cgroup" && has_name(options, controller);
    if (found) return mount;
  }
  return std::nullopt;
}

// The process's group by /proc/self/cgroup, whose lines are "0::/path" for v2 and "4:cpu,cpuacct:/path" for
// v1.
std::optional<std::string> find_group(CgroupVersion version, std::string_view controller,
                                      const std::string& root) {
  std::ifstream file(root + "/proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {
    const size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool found =
        version == CgroupVersion::kV2 ? line.starts_with("0::") : has_name(controllers, controller);
    if (found) return line.substr(second + 1);
  }
  return std::nullopt;
}

}  // namespace

std::vector<fs::path> control_group_folders(CgroupVersion version, std::string_view controller,
                                            const std::string& root) {
  const std::optional<Mount> mount = find_mount(version, controller, root);
  const std::optional<std::string> group = find_group(version, controller, root);
  if (!mount || !group) return {};
  std::vector<fs::path> folders = {root + mount->point};
  // A group outside the mount shows as "/.." or under another root; only the mount point can be read then.
  const fs::path inside = fs::path(*group).lexically_relative(mount->root);
  if (inside.empty() || std::find(inside.begin(), inside.end(), "..") != inside.end()) return folders;
  for (const fs::path& name : inside)
    if (name != ".") folders.push_back(folders.back() / name);
  return folders;
}

}  // namespace kaustik::app
