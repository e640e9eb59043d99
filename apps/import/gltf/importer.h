#pragma once
// Imports glTF 2.0 scenes as pbrt directives (docs/reference/scene_format.md lists the mapping).

#include <filesystem>
#include <optional>

#include "apps/settings/table/import_options.h"
#include "core/diagnostics/diagnostics.h"
#include "core/scene/description/description.h"

namespace kaustik::gltf {

// Reads a .gltf or .glb file with its buffers. Nothing, with an error in `diagnostics`, when it is damaged: a
// byte range beyond its buffer, an index out of range, a node that is its own ancestor, too many vertices.
// Each feature that is ignored or approximated gives one warning.
std::optional<SceneDescription> import_gltf(const ReadableFile& file, Diagnostics& diagnostics,
                                            const ImportOptions& options = {});

// Decides by the file name's extension.
bool is_gltf(const std::filesystem::path& path);

}  // namespace kaustik::gltf
