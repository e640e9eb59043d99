#pragma once
#include <filesystem>
#include <string>

namespace kaustik {

// How the name of an auxiliary file beside `path` begins: a dot, the file's name, a dot. Of a long name it
// takes as much as leaves room for an ending in the 255 bytes of a name.
std::string hidden_name_beginning(const std::filesystem::path& path);

}  // namespace kaustik
