#pragma once
// When and how a session denoises its picture.

#include <optional>

#include "apps/console/console.h"
#include "apps/settings/table/settings.h"
#include "render/picture/image.h"
#include "render/renderer.h"

namespace kaustik::app {

// Renders of at most this many samples a pixel are denoised unless the settings say otherwise.
inline constexpr int kSamplesDenoised = 256;

// Where the settings leave it open, turns denoising on for renders of few samples, and off for those whose
// numbers count: several passes, an error to reach or to show, partial results (writes_sums), crops, whose
// pixels are those of the whole picture, and `mc`. Renders for --time stay open: see
// stopping/denoising_time.h.
void settle_denoising(bool writes_sums, Settings* settings);

// The denoised picture, if the settings ask for it. Nothing, with a message, if the samples have no halves or
// memory does not suffice. Sets *seconds to what it took.
std::optional<render::Image> denoised(const render::RenderResult& result,
                                      const render::RenderSettings& settings, const Console& console,
                                      double* seconds);

}  // namespace kaustik::app
