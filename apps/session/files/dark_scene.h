#pragma once
// Says why a scene would give a black picture.

#include <string>

#include "core/scene/description/description.h"
#include "core/scene/scene.h"

namespace kaustik::app {

// One sentence if nothing in the scene shines; empty otherwise.
std::string why_black(const Scene& scene, const SceneDescription& description);

}  // namespace kaustik::app
