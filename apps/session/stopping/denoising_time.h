#pragma once
// How long denoising takes, for renders that have a given time.

#include "apps/console/console.h"
#include "apps/settings/table/settings.h"
#include "core/camera/camera.h"

namespace kaustik::app {

// Seconds that denoising will take after the render, by a trial; 0 if the settings do not ask for it.
double denoising_seconds(const render::RenderSettings& settings, const Camera& camera);

// Where the settings of a render with a given time leave it open, turns denoising on, unless it would take a
// large part of that time, which is logged. Call it within the render's task arena.
void settle_timed_denoising(const Camera& camera, const Console& console, Settings* settings);

}  // namespace kaustik::app
