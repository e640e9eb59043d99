#pragma once
#include <assimp/material.h>

#include "apps/import/warnings.h"
#include "core/scene/description.h"

namespace kaustik {

// The nearest material of pbrt, without a name. Textures that it needs are added to the scene.
MaterialDescription material_of_mtl(const aiMaterial& mtl, FileWarnings& warnings, SceneDescription& scene);

// Ke as the radiance of an area light; nothing where it is black.
std::optional<Directive> lamp_of_mtl(const aiMaterial& mtl, const SourceLocation& where);

// map_d as the `alpha` of shapes.
std::optional<Parameter> alpha_of_mtl(const aiMaterial& mtl, FileWarnings& warnings, SceneDescription& scene);

}  // namespace kaustik
