#pragma once
#include <assimp/material.h>

#include <filesystem>

#include "apps/import/common/warnings.h"
#include "apps/import/obj/mtl_text.h"
#include "core/scene/description/description.h"

namespace kaustik {

// What the functions below need besides the material itself.
struct MtlContext {
  const MapOptionsOf& options;
  const std::filesystem::path& folder;  // of the map files
  FileWarnings& warnings;
  SceneDescription& scene;
};

// The nearest pbrt material, without a name. Textures that it needs are added to the scene.
MaterialDescription material_of_mtl(const aiMaterial& mtl, const MtlContext& context);

// An area light of radiance Ke, or of the image map_Ke times Ke's largest component. Nothing if the material
// does not emit.
std::optional<Directive> light_of_mtl(const aiMaterial& mtl, const SourceLocation& where);

// The `alpha` parameter of shapes from map_d or d; nothing for opaque and for clear materials.
std::optional<Parameter> alpha_of_mtl(const aiMaterial& mtl, const MtlContext& context);

}  // namespace kaustik
