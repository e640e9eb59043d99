#pragma once
// Converts the meshes of a glTF file to pbrt triangle meshes.

#include "apps/import/common/warnings.h"
#include "apps/import/gltf/document.h"
#include "core/scene/description/description.h"

namespace kaustik::gltf {

// P, N, uv and indices of a primitive; nothing, with a warning, for points and lines. `uv_set`: which set of
// texture coordinates to read; they are flipped so that t points up, as in pbrt. `total`: the numbers read so
// far for the scene; grows here, and beyond a limit the file is refused (FormatError).
std::optional<ShapeDescription> triangles_of(const Document& document, const View& primitive, uint64_t uv_set,
                                             uint64_t& total, FileWarnings& warnings);

// The mean of the primitive's vertex colours, by which the base colour is multiplied; 1 if it has none.
glm::dvec3 mean_vertex_colour(const Document& document, const View& primitive, FileWarnings& warnings);

}  // namespace kaustik::gltf
