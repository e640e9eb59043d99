#pragma once
// The pixels of an image that a light emits.

#include <vector>

#include "core/math/vec.h"

namespace kaustik {

// An image that a light emits: linear Rec. 709, row 0 at the top, finite and not negative.
struct LightImage {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;

  const Rgb& at(int x, int y) const {
    return pixels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
};

}  // namespace kaustik
