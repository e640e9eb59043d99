#pragma once
// Builds the scene that is rendered from a located description.

#include <functional>
#include <optional>
#include <string>

#include "core/diagnostics/diagnostics.h"
#include "core/scene/description/description.h"
#include "core/scene/scene.h"
#include "core/texture/image_lookup.h"

namespace kaustik {

// The result of loading a mesh file: a mesh in object space, or an error.
struct MeshResult {
  TriangleMesh mesh;
  std::string error;  // one sentence that names the file; empty on success
};
// Reads the mesh that the parameter at `where` names. Called from several threads at once.
using MeshLoader = std::function<MeshResult(const std::string& filename, const SourceLocation& where)>;

// The result of loading an image file: a linear Rec. 709 image, or an error.
struct LightImageResult {
  LightImage image;
  std::string error;  // one sentence that names the file; empty on success
};
// Reads the image of a light that the parameter at `where` names.
using LightImageLoader =
    std::function<LightImageResult(const std::string& filename, const SourceLocation& where)>;

// Resolves names, checks every parameter against the schema, loads meshes and images in parallel, bakes
// object instances and transforms into world space, and joins shapes to surface groups. Returns nothing after
// any error. All errors and warnings are added to diagnostics, in an order that does not depend on the
// threads. Shapes are in file order, with those of instances after the others; lights are the LightSource
// lines in file order, then emitting shapes.
std::optional<Scene> build_scene(const SceneDescription& description, const MeshLoader& load_mesh,
                                 Diagnostics& diagnostics, const LightImageLoader& load_light_image = {},
                                 const ImageLoader& images = {});

}  // namespace kaustik
