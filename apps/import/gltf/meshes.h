#pragma once
// Meshes of a glTF file as triangle meshes of pbrt.

#include "apps/import/gltf/document.h"
#include "apps/import/warnings.h"
#include "core/scene/description/description.h"

namespace kaustik::gltf {

// P, N, uv and indices of a primitive; nothing, with a warning, for points and lines. uv_set: which of the
// texture coordinates. t points up, as in pbrt. total: of vertices and corners so far, which grows and is
// refused beyond what fits.
std::optional<ShapeDescription> triangles_of(const Document& document, const View& primitive, uint64_t uv_set,
                                             uint64_t& total, FileWarnings& warnings);

// What the colours of its vertices multiply the base colour by, on the mean; 1 without.
glm::dvec3 mean_vertex_colour(const Document& document, const View& primitive, FileWarnings& warnings);

}  // namespace kaustik::gltf
