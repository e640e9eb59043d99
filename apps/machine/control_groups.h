#pragma once
// The control groups that the process belongs to (cgroups(7)): where the kernel shows their limits.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace kaustik::app {

enum class CgroupVersion { kV1, kV2 };

// The folders of the process's group and of its visible ancestors, outermost first: a limit in any of them
// binds the process. v2 has one hierarchy; of v1 the one of `controller` ("cpu", "memory"). root: where /proc
// and /sys are looked for, for tests. Empty when there is no such hierarchy.
std::vector<std::filesystem::path> control_group_folders(CgroupVersion version, std::string_view controller,
                                                         const std::string& root = "");

}  // namespace kaustik::app
