#pragma once
// MTL files, put into what assimp reads: it gives up at words that it does not know, and drops the options of
// maps.

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "apps/import/warnings.h"

namespace kaustik {

// What stands before the name of a map: `-s 2 2 -o 0.5 0 -clamp on`.
struct MapOptions {
  std::array<double, 2> scale{1, 1}, offset{0, 0};
  bool clamp = false;
};

// Options of the maps of all materials, by material and keyword: "wood", "map_kd".
using MapOptionsOf = std::map<std::pair<std::string, std::string>, MapOptions>;

// Lines that assimp has a use for, with maps by nothing but their names. Maps that are not there are sought
// by their last name beside the file, and else left out; that, and other lines without effect, are warnings.
std::string clean_mtl(std::string_view text, const std::filesystem::path& folder, FileWarnings& warnings,
                      MapOptionsOf& options);

}  // namespace kaustik
