#pragma once
// How a session shows radiance in PNG and JPEG files.

#include "apps/console/console.h"
#include "apps/settings/table/settings.h"
#include "render/film/film.h"
#include "render/picture/image.h"
#include "render/picture/tonemap.h"

namespace kaustik::app {

// Whether an output file of this name holds what a screen shows, in place of radiance.
bool shows_tones(const std::string& path);

// The tone mapping that the settings ask for, with the picture's own exposure if they leave it open. That
// exposure is logged as an option that repeats it. `film`: the picture's, or null if only its pixels are
// known.
render::ToneSettings tone_for(const render::Image& picture, const render::Film* film,
                              const ToneChoice& choice, const Console& console);

}  // namespace kaustik::app
