#pragma once
// A legend in a corner of a picture.

#include <span>
#include <string>

#include "render/picture/image.h"

namespace kaustik::render {

struct LegendEntry {
  glm::u8vec3 colour;  // in sRGB
  std::string text;    // small letters and blanks
};

// Draws a field of its colour and the text of each entry into the picture's lower left corner, on a darker
// ground. The picture holds linear display values. Larger pictures get larger letters. Returns false, and
// draws nothing, where the legend would be wider than the picture or higher than half of it.
bool draw_legend(Image& image, std::span<const LegendEntry> entries);

}  // namespace kaustik::render
