#pragma once
// The pictures that a report shows, of a size that keeps it fit to send.

#include <string>

#include "render/picture/image.h"
#include "render/picture/tonemap.h"

namespace kaustik::app {

inline constexpr int kPictureSide = 400;  // pixels of the longer side, at most

// Tone-mapped PNG.
void write_picture(const std::string& path, const render::Image& image, const render::ToneSettings& tone);

// Relative squared error per pixel in false colours (render/picture/compare.h); averaged before it is
// coloured.
void write_error_map(const std::string& path, const render::Image& reference, const render::Image& image);

}  // namespace kaustik::app
