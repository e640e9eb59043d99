#pragma once
// A rectangle of pixels of the full image.

#include <algorithm>

namespace kaustik::render {

// Pixels [x0, x1) x [y0, y1).
struct PixelRange {
  int x0, x1, y0, y1;

  // Its part within `side` pixels of (x, y) to the right and below.
  PixelRange in_square(int x, int y, int side) const {
    return {std::max(x0, x), std::min(x1, x + side), std::max(y0, y), std::min(y1, y + side)};
  }
};

}  // namespace kaustik::render
