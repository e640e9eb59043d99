#pragma once
#include <assimp/material.h>

#include <filesystem>

#include "apps/import/obj/mtl_text.h"
#include "apps/import/warnings.h"
#include "core/scene/description/description.h"

namespace kaustik {

// What a material is read with: options of maps, and the folder that these lie in.
struct MtlContext {
  const MapOptionsOf& options;
  const std::filesystem::path& folder;
  FileWarnings& warnings;
  SceneDescription& scene;
};

// The nearest material of pbrt, without a name. Textures that it needs are added to the scene.
MaterialDescription material_of_mtl(const aiMaterial& mtl, const MtlContext& context);

// Ke, or map_Ke times it, as the radiance of an area light; nothing where it is black.
std::optional<Directive> light_of_mtl(const aiMaterial& mtl, const SourceLocation& where);

// map_d, or d, as the `alpha` of shapes.
std::optional<Parameter> alpha_of_mtl(const aiMaterial& mtl, const MtlContext& context);

}  // namespace kaustik
