#pragma once
// Pictures of coloured characters, for every terminal that knows 24-bit colours: each cell is the character
// U+2580, the upper half of a block, whose colours are those of two pixels, one above the other.

#include <string>
#include <vector>

#include "apps/live/terminal/pixels8.h"

namespace kaustik::app {

// The bytes of each line of cells. Below an odd last row of pixels the background stays.
std::vector<std::string> half_block_lines(const Pixels8& pixels);

// The bytes that draw lines from where the cursor is, column by column below each other, but only those that
// differ from the lines of `shown` with the same number. Empty if none does.
std::string draw_lines(const std::vector<std::string>& lines, const std::vector<std::string>& shown);

}  // namespace kaustik::app
