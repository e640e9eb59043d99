#pragma once
// Writes the meshes of a scene description as PLY files.

#include <optional>
#include <string>

#include "core/scene/description/description.h"

namespace kaustik::app {

// A "trianglemesh" as the bytes of a binary little-endian PLY file with positions, normals, u and v as
// floats. Nothing if that would lose information (numbers that floats cannot hold, parameters per face) or
// the mesh is invalid.
std::optional<std::string> ply_bytes(const ShapeDescription& mesh);

}  // namespace kaustik::app
