#pragma once
// How long denoising takes, for renders that have a given time.

#include "apps/console/console.h"
#include "apps/settings/table/settings.h"
#include "core/camera/camera.h"

namespace kaustik::app {

// Seconds that denoising will take after a render with a given time, by a trial; 0 without denoising or
// without such a time. Where the settings leave it open, turns denoising on, unless it would take a large
// part of that time, which is logged. Call it within the render's task arena.
double settle_timed_denoising(const Camera& camera, const Console& console, Settings* settings);

}  // namespace kaustik::app
