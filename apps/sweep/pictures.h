#pragma once
// Writes the pictures of a report, reduced so that the report stays small enough to send.

#include <string>

#include "render/picture/image.h"
#include "render/picture/tonemap.h"

namespace kaustik::app {

inline constexpr int kPictureSide = 400;  // most pixels of the longer side

// Writes a tone-mapped PNG.
void write_picture(const std::string& path, const render::Image& image, const render::ToneSettings& tone);

// Writes a PNG of the relative squared error per pixel in false colours (render/compare/compare.h). Errors
// are averaged to the reduced size before they are coloured.
void write_error_map(const std::string& path, const render::Image& reference, const render::Image& image);

}  // namespace kaustik::app
