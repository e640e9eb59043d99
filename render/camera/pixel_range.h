#pragma once
// A rectangle of pixels of the full image.

#include <algorithm>
#include <cstdint>

#include "core/camera/camera.h"
#include "render/settings/settings.h"

namespace kaustik::render {

// Pixels [x0, x1) x [y0, y1).
struct PixelRange {
  int x0, x1, y0, y1;

  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  uint64_t pixels() const { return uint64_t(width()) * uint64_t(height()); }

  // Intersection with the square of `side` pixels whose top left corner is (x, y).
  PixelRange in_square(int x, int y, int side) const {
    return {std::max(x0, x), std::min(x1, x + side), std::max(y0, y), std::min(y1, y + side)};
  }

  // Calls fn(part) for the range's parts in a grid of squares of this side, counted from the corner of the
  // full image.
  template <class Fn>
  void for_each_square(int side, const Fn& fn) const {
    for (int y = y0 - y0 % side; y < y1; y += side)
      for (int x = x0 - x0 % side; x < x1; x += side) fn(in_square(x, y, side));
  }
};

// Pixels of the camera's image that are rendered: the crop window, or all of them.
inline PixelRange rendered_range(const CropWindow& crop, const Camera& camera) {
  if (crop.empty()) return {0, camera.width, 0, camera.height};
  return {crop.x0, crop.x1, crop.y0, crop.y1};
}

}  // namespace kaustik::render
