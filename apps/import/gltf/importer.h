#pragma once
// glTF 2.0 scenes as directives of pbrt (docs/reference/scene_format.md says what becomes of what).

#include <filesystem>
#include <optional>

#include "core/diagnostics/diagnostics.h"
#include "core/scene/description/description.h"

namespace kaustik::gltf {

// Reads a .gltf or .glb file, with its buffers. Nothing, with an error that says what was wrong, when it is
// damaged: a byte range beyond its buffer, an index out of range, a node that is its own ancestor, more
// vertices than fit. What is left out or approximated is one warning each.
std::optional<SceneDescription> import_gltf(const std::filesystem::path& path, Diagnostics& diagnostics);

// By the name's ending.
bool is_gltf(const std::filesystem::path& path);

}  // namespace kaustik::gltf
