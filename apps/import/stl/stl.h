#pragma once
// Loads triangle meshes from STL files, binary and ASCII.

#include "core/files/read_root.h"
#include "core/scene/shapes/mesh_loader.h"

namespace kaustik {

// Corners of the same position become one vertex; there are neither normals nor texture coordinates, since
// the normals in STL files are those of the facets. Facets with a position that is not finite are left out.
// Errors: a file that ends within a facet, coordinates that are no numbers. `content` receives the
// ContentHash of the file if it could be read.
MeshResult load_stl(const ReadableFile& file, std::string* content);

}  // namespace kaustik
