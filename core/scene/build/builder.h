#pragma once
// Builds the scene that is rendered from a located description.

#include <optional>

#include "core/diagnostics/diagnostics.h"
#include "core/light/image/light_image.h"
#include "core/scene/description/description.h"
#include "core/scene/scene.h"
#include "core/scene/shapes/mesh_loader.h"
#include "core/texture/image_lookup.h"

namespace kaustik {

// Resolves names, checks every parameter against the schema, loads meshes and images in parallel, bakes
// object instances and transforms into world space, and joins shapes to surface groups. Returns nothing after
// any error. All errors and warnings are added to diagnostics, in an order that does not depend on the
// threads. Shapes are in file order, with those of instances after the others; lights are the LightSource
// lines in file order, then emitting shapes.
std::optional<Scene> build_scene(const SceneDescription& description, const MeshLoader& load_mesh,
                                 Diagnostics& diagnostics, const LightImageLoader& load_light_image = {},
                                 const ImageLoader& images = {});

}  // namespace kaustik
