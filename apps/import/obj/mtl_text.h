#pragma once
// Rewrites MTL files into a form that assimp reads. Assimp gives up at unknown keywords and drops the options
// of maps.

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "apps/import/common/warnings.h"

namespace kaustik {

// The options before a map's file name, as in `-s 2 2 -o 0.5 0 -clamp on`.
struct MapOptions {
  std::array<double, 2> scale{1, 1}, offset{0, 0};
  bool clamp = false;
};

// Map options by material name and lower-case keyword, such as {"wood", "map_kd"}.
using MapOptionsOf = std::map<std::pair<std::string, std::string>, MapOptions>;

// Returns the lines that matter to assimp, with the options of maps removed and stored in `options`. A map
// that does not exist is looked for by its file name in `folder`, and otherwise dropped with a warning.
// Unknown keywords are dropped with a warning too.
std::string clean_mtl(std::string_view text, const std::filesystem::path& folder, FileWarnings& warnings,
                      MapOptionsOf& options);

}  // namespace kaustik
