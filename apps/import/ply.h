#pragma once
// Triangle meshes from PLY files (Turk 1994; ascii, little and big endian).

#include <filesystem>

#include "core/scene/builder.h"

namespace kaustik::pbrt {

// Vertices keep their order and number; normals (nx ny nz) and texture coordinates (u v, s t and the like)
// are kept where every vertex has them; quads and polygons are triangulated. The file's structure is checked
// in full before anything is allocated from what it claims: a header that promises more than the file holds,
// a truncated file, faces of fewer than three vertices and indices out of range are refused with the place in
// the file. content: takes the ContentHash of the file, if it could be read. Thread-safe.
MeshResult load_ply(const std::filesystem::path& path, std::string* content = nullptr);

}  // namespace kaustik::pbrt
