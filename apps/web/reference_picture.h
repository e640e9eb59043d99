#pragma once
// A picture from a file that the live page compares the render with.

#include <string>
#include <vector>

#include "render/camera/pixel_range.h"

namespace kaustik::app {

// Radiance r, g, b of the pixels of `range`, row by row. The file may have the size of the full picture or of
// the range, or be a crop that holds it. Throws ExitError (bad command line) for other files.
std::vector<float> read_reference(const std::string& path, const render::PixelRange& range, int full_width,
                                  int full_height);

}  // namespace kaustik::app
