#pragma once
// Loads scenes from the scenes/ folder.

#include <filesystem>
#include <stdexcept>
#include <string>

#include "apps/import/import_scene.h"

namespace kaustik::test {

// file: relative to scenes/. Throws when it does not load.
inline Scene scene_from(const std::string& file) {
  Diagnostics diagnostics;
  auto loaded = pbrt::load_scene(std::filesystem::path(KAUSTIK_SCENES_DIR) / file, diagnostics);
  if (!loaded) throw std::runtime_error(file + " does not load");
  return std::move(loaded->scene);
}

}  // namespace kaustik::test
