#pragma once
// Imports mesh files (PLY, STL) that are a scene by themselves: one mesh, grey or of
// the colours of its vertices, with the camera and the
// light of files that have none.

#include <filesystem>
#include <optional>

#include "core/diagnostics/diagnostics.h"
#include "core/scene/description/description.h"

namespace kaustik {

// Decides by the file name's extension: .ply, .stl.
bool is_lone_mesh(const std::filesystem::path& path);

// Nothing, with an error in `diagnostics`, when the file cannot be read or has no triangles.
std::optional<SceneDescription> import_lone_mesh(const ReadableFile& file, Diagnostics& diagnostics);

}  // namespace kaustik
