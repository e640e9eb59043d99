#pragma once
// Reads scenes in pbrt-v4's text format (docs/reference/scene_format.md), glTF, OBJ, and PLY and STL as
// scenes of one mesh; the file name's extension decides.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/settings/table/import_options.h"
#include "core/diagnostics/diagnostics.h"
#include "core/scene/description/description.h"
#include "core/scene/scene.h"

namespace kaustik::pbrt {

// Reads the file and the files that it includes into a description; meshes are not opened. After errors the
// description holds what could be read, so that later stages can report their errors in the same run: call
// diagnostics.has_errors(). Nothing when the file itself cannot be read. Throws only std::bad_alloc.
std::optional<SceneDescription> import_scene(const std::filesystem::path& path, Diagnostics& diagnostics,
                                             const ImportOptions& options = {});

// Applies --look-at and --fov to a description of the file `path`, of which only camera and film need be
// there.
void place_camera(const std::filesystem::path& path, const ViewOptions& options, SceneDescription* scene,
                  Diagnostics& diagnostics);

struct LoadedScene {
  Scene scene;
  // The film, sampler and integrator directives are left for the caller to interpret (apps/settings). Their
  // types and parameters are checked against the schema, except those of the integrator.
  SceneDescription description;
  // ContentHash, 32 hexadecimal digits, of the file, the files that it includes, and the meshes and images
  // that it names. It does not depend on the folders that they lie in.
  std::string content_hash;
  // Every file that was read: the scene's texts, and the meshes and images that it names.
  std::vector<std::string> files;
};

// Calls import_scene, then build_scene, which loads meshes and images in parallel. Nothing after any error;
// `diagnostics` then holds all errors of both steps, sorted by location. Warnings do not make it fail.
std::optional<LoadedScene> load_scene(const std::filesystem::path& path, Diagnostics& diagnostics,
                                      const ImportOptions& options = {});

}  // namespace kaustik::pbrt
