#pragma once
// Pictures by the graphics protocol of kitty (https://sw.kovidgoyal.net/kitty/graphics-protocol), which
// Ghostty, Konsole and WezTerm know as well.

#include <cstdint>
#include <optional>
#include <string>

#include "apps/live/terminal/pixels8.h"

namespace kaustik::app {

struct KittyPlace {
  uint32_t id = 1;  // a picture with the id of an earlier one replaces it
  // Cells to which the picture is stretched; 0: it is shown pixel by pixel.
  int columns = 0, rows = 0;
};

// Draws a picture whose upper left corner is the cell of the cursor, which stays there. The terminal does not
// answer.
std::string kitty_picture(const Pixels8& pixels, const KittyPlace& place);

// Removes the picture with this id.
std::string kitty_removal(uint32_t id);

}  // namespace kaustik::app
