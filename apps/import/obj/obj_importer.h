#pragma once
// Wavefront OBJ files with their MTL materials, read by assimp, as directives of pbrt
// (docs/reference/scene_format.md says what becomes of what).

#include <filesystem>
#include <optional>

#include "core/diagnostics/diagnostics.h"
#include "core/scene/description/description.h"

namespace kaustik {

// Nothing, with an error that says what was wrong, when the file cannot be read: indices out of range,
// positions that are not finite, no faces at all. What is left out is one warning each.
std::optional<SceneDescription> import_obj(const std::filesystem::path& path, Diagnostics& diagnostics);

// By the name's ending.
bool is_obj(const std::filesystem::path& path);

}  // namespace kaustik
