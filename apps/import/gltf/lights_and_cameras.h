#pragma once
#include "apps/import/common/warnings.h"
#include "apps/import/gltf/file/document.h"
#include "apps/settings/table/import_options.h"
#include "core/scene/description/description.h"

namespace kaustik::gltf {

// Sets the scene's camera and film. glTF's cameras look along -z. The film is 720 pixels high; its width
// follows from the aspect ratio, 16:9 if the file states none.
void add_camera(const View& camera, const glm::dmat4& to_world, FileWarnings& warnings,
                SceneDescription& scene);

// Adds the node's light of KHR_lights_punctual, if it has one. `unit`: what its intensity means; candela and
// lux are divided by 683 lm/W, of which the first light adds a note to the scene.
void add_light(const Document& document, const View& node, const glm::dmat4& to_world, LightUnit unit,
               FileWarnings& warnings, SceneDescription& scene);

}  // namespace kaustik::gltf
