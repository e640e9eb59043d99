#pragma once
// How long denoising takes, for renders that have a given time.

#include "core/camera/camera.h"
#include "render/settings/settings.h"

namespace kaustik::app {

// Seconds that denoising will take after the render, by a trial; 0 if the settings do not ask for it.
double denoising_seconds(const render::RenderSettings& settings, const Camera& camera);

}  // namespace kaustik::app
