#pragma once
// Reads scenes: pbrt-v4's text format (docs/reference/scene_format.md), and by their ending glTF and OBJ.

#include <filesystem>
#include <optional>

#include "core/diagnostics/diagnostics.h"
#include "core/scene/description/description.h"
#include "core/scene/scene.h"

namespace kaustik::pbrt {

// Reads the file, and what it includes, into a description; meshes are not opened. After errors the
// description holds what could be read, so that later stages can report theirs in the same run: ask
// diagnostics.has_errors(). Nothing when the file itself cannot be read. Throws nothing but std::bad_alloc.
std::optional<SceneDescription> import_scene(const std::filesystem::path& path, Diagnostics& diagnostics);

struct LoadedScene {
  Scene scene;
  // Film, sampler and integrator lines are left for the caller to interpret (apps/settings); their types and
  // parameters are checked against the schema except those of the integrator.
  SceneDescription description;
  // ContentHash of the file, what it includes and the meshes that it names, wherever they lie: in 32 digits.
  std::string content_hash;
};

// import_scene, then build_scene with the meshes that it names, loaded in parallel. Nothing after any error;
// diagnostics then holds all errors of the run, ordered by place. Warnings alone do not fail.
std::optional<LoadedScene> load_scene(const std::filesystem::path& path, Diagnostics& diagnostics);

}  // namespace kaustik::pbrt
