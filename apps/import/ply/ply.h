#pragma once
// Triangle meshes from PLY files (Turk 1994; ascii, little and big endian), packed by gzip or not.

#include <filesystem>

#include "core/scene/build/builder.h"

namespace kaustik::pbrt {

// Vertices keep their order and number; normals (nx ny nz) and texture coordinates (u v, s t, texture_u
// texture_v, texture_s texture_t) are kept where every vertex has them; quads and polygons are triangulated,
// concave ones by cutting off ears. The file's structure is checked before anything is allocated from what it
// claims: a header that promises more than the file holds, a truncated file, faces of fewer than three
// vertices, indices out of range and positions that are not finite are refused with the place in the file.
// Read in parallel. content: takes the ContentHash of the file, if it could be read. Thread-safe.
MeshResult load_ply(const std::filesystem::path& path, std::string* content = nullptr);

}  // namespace kaustik::pbrt
