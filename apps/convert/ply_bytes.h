#pragma once
// Meshes of a description as PLY files.

#include <optional>
#include <string>

#include "core/scene/description/description.h"

namespace kaustik::app {

// A "trianglemesh" as a binary little-endian PLY file: positions, normals, u and v as floats. Nothing where
// that would lose something: numbers that are no floats, or parameters per face.
std::optional<std::string> ply_bytes(const ShapeDescription& mesh);

}  // namespace kaustik::app
