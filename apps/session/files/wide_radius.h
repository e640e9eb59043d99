#pragma once
// Says when the gather radius is too wide for the scene.

#include <string>

#include "core/scene/scene.h"
#include "render/settings/settings.h"

namespace kaustik::app {

// One sentence if the settings give a gather radius that is a large share of the scene's size, with the radii
// that are usual there; empty otherwise, and for settings that gather no photons.
std::string why_wide(const Scene& scene, const render::RenderSettings& settings);

}  // namespace kaustik::app
