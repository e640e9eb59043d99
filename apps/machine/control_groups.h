#pragma once
// Finds the control groups (cgroups(7)) that the process belongs to.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace kaustik::app {

enum class CgroupVersion { kV1, kV2 };

// The folders of the process's group and of its visible ancestors, outermost first; a limit in any of them
// binds the process. v2 has one hierarchy, v1 one per `controller` ("cpu", "memory"). `root`: a prefix of
// /proc and /sys, for tests. Empty when there is no such hierarchy.
std::vector<std::filesystem::path> control_group_folders(CgroupVersion version, std::string_view controller,
                                                         const std::string& root = "");

}  // namespace kaustik::app
