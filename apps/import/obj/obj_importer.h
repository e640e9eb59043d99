#pragma once
// Imports Wavefront OBJ files with their MTL materials as pbrt directives (docs/reference/scene_format.md
// lists the mapping).

#include <filesystem>
#include <optional>

#include "core/diagnostics/diagnostics.h"
#include "core/scene/description/description.h"

namespace kaustik {

// Nothing, with an error in `diagnostics`, when the file cannot be read or the picture would be wrong:
// coordinates that are no numbers, vertex indices out of range, no faces at all. Each kind of thing that is
// left out gives one warning.
std::optional<SceneDescription> import_obj(const ReadableFile& file, Diagnostics& diagnostics);

// Decides by the file name's extension.
bool is_obj(const std::filesystem::path& path);

}  // namespace kaustik
