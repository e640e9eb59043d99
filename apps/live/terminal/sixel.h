#pragma once
// Pictures by sixels, which terminals have known since DEC's VT340: foot, mlterm, xterm, Windows Terminal.

#include <string>

#include "apps/live/terminal/pixels8.h"

namespace kaustik::app {

inline constexpr int kSixelRows = 6;  // of pixels, which are sent together

// Draws a picture whose upper left corner is the cell of the cursor, which moves. Colours are those of a
// fixed palette of 252, 6 levels of red, 7 of green and 6 of blue, dithered in a fixed order.
std::string sixel_picture(const Pixels8& pixels);

}  // namespace kaustik::app
