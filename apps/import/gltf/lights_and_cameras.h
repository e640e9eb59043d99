#pragma once
#include "apps/import/gltf/document.h"
#include "apps/import/warnings.h"
#include "core/scene/description/description.h"

namespace kaustik::gltf {

// A camera of glTF looks along -z; its image is 720 pixels high unless the file says its shape.
void add_camera(const View& camera, const glm::dmat4& to_world, FileWarnings& warnings,
                SceneDescription& scene);

// The node's light of KHR_lights_punctual, if it has one. Candela and lux are taken as our W/sr and W/m^2, as
// pbrt takes photometric units.
void add_light(const Document& document, const View& node, const glm::dmat4& to_world, FileWarnings& warnings,
               SceneDescription& scene);

}  // namespace kaustik::gltf
