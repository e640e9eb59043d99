#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "core/files/read_root.h"

namespace kaustik {

// Finds a file by a name that may have been written on another machine: with backslashes, with an absolute
// path of that machine, in other letter case. Looks in each folder for the whole name, then for what is left
// of it without its first folders, down to the file name alone; each as it is written first, then in any
// letter case. An absolute name that exists is taken as it is. Only regular files count. If none is found and
// the whole name leads out of the root, the file that is returned is a refused one.
std::optional<ReadableFile> find_file(const ReadRoot& root, const std::string& name,
                                      std::span<const std::filesystem::path> folders);

}  // namespace kaustik
