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

  // fn(part) for its parts in squares of this side, which are counted from the corner of the full image.
  template <class Fn>
  void for_each_square(int side, const Fn& fn) const {
    for (int y = y0 - y0 % side; y < y1; y += side)
      for (int x = x0 - x0 % side; x < x1; x += side) fn(in_square(x, y, side));
  }
};

}  // namespace kaustik::render
