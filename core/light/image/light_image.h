#pragma once
// The pixels of an image that a light emits, and what loads them.

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "core/diagnostics/source_location.h"
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

// The row or column of `n` that a coordinate in [0, 1] lies in; coordinates outside belong to the nearest
// one.
inline int cell_of(float u, int n) {
  return std::clamp(static_cast<int>(u * static_cast<float>(n)), 0, n - 1);
}

// The result of loading an image file: a linear Rec. 709 image, or an error.
struct LightImageResult {
  LightImage image;
  std::string error;  // one sentence that names the file; empty on success
};
// Reads the image of a light that the parameter at `where` names.
using LightImageLoader =
    std::function<LightImageResult(const std::string& filename, const SourceLocation& where)>;

}  // namespace kaustik
