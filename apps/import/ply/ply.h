#pragma once
// Loads triangle meshes from PLY files (Turk 1994; ASCII, little and big endian), optionally compressed by
// gzip.

#include "core/files/read_root.h"
#include "core/scene/build/builder.h"

namespace kaustik::pbrt {

// Vertices keep their order and number. Normals (nx ny nz) and texture coordinates (u v, s t, texture_u
// texture_v, texture_s texture_t) are read if the vertex element declares them; so are colours (red green
// blue, and alpha), if `colours` is set: whole numbers are sRGB, floats linear. Quads and polygons are
// triangulated, concave ones by ear clipping. The structure of the file is checked before any memory is
// allocated for it. Errors that name the byte in the file: a header that promises more than the file holds, a
// truncated file, faces of fewer than three vertices, indices out of range, positions that are not finite.
// Blocks are read in parallel. `content` receives the ContentHash of the file if it could be read.
// Thread-safe.
MeshResult load_ply(const ReadableFile& file, std::string* content = nullptr, bool colours = false);

}  // namespace kaustik::pbrt
