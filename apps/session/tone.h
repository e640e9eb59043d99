#pragma once
// How a session shows radiance in PNG and JPEG files.

#include "apps/console/console.h"
#include "apps/settings/table/settings.h"
#include "render/picture/image.h"
#include "render/picture/tonemap.h"

namespace kaustik::app {

// Whether an output file of this name holds what a screen shows, in place of radiance.
bool shows_tones(const std::string& path);

// The tone mapping that the settings ask for, with the picture's own exposure if they leave it open. That
// exposure is logged as an option that repeats it. `lights`: lights_seen() of the picture.
render::ToneSettings tone_for(const render::Image& picture, const render::Image& lights,
                              const ToneChoice& choice, const Console& console);

}  // namespace kaustik::app
