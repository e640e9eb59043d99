#pragma once
#include "apps/import/common/warnings.h"
#include "apps/import/gltf/document.h"
#include "core/scene/description/description.h"

namespace kaustik::gltf {

// Sets the scene's camera and film. glTF's cameras look along -z. The film is 720 pixels high; its width
// follows from the aspect ratio, 16:9 if the file states none.
void add_camera(const View& camera, const glm::dmat4& to_world, FileWarnings& warnings,
                SceneDescription& scene);

// Adds the node's light of KHR_lights_punctual, if it has one. Candela and lux are read as W/sr and W/m^2, as
// pbrt reads photometric units.
void add_light(const Document& document, const View& node, const glm::dmat4& to_world, FileWarnings& warnings,
               SceneDescription& scene);

}  // namespace kaustik::gltf
