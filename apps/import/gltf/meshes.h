#pragma once
// Converts the meshes of a glTF file to pbrt triangle meshes.

#include "apps/import/common/warnings.h"
#include "apps/import/gltf/file/document.h"
#include "apps/import/gltf/textures.h"
#include "core/scene/description/description.h"

namespace kaustik::gltf {

// Whether the primitive has triangles; points and lines give a warning.
bool has_triangles(const View& primitive, FileWarnings& warnings);

// P, N, uv and indices of a primitive that has triangles; nothing if there are none. `source`: which
// texture coordinates to read; they are flipped so that t points up, as in pbrt. `total`: the numbers read so
// far for the scene; grows here, and beyond a limit the file is refused (FormatError).
std::optional<ShapeDescription> triangles_of(const Document& document, const View& primitive,
                                             const UvSource& source, uint64_t& total, FileWarnings& warnings);

// The colours of a primitive's vertices, by which the base colour is multiplied.
struct VertexColours {
  glm::dvec4 common{1};      // red, green, blue and alpha of all vertices, unless they differ
  std::vector<double> each;  // four numbers a vertex; empty unless they differ
};
VertexColours vertex_colours(const Document& document, const View& primitive, uint64_t& total);

}  // namespace kaustik::gltf
