#pragma once
// One number for each pixel of a picture, with a border of zeros, so that windows and SIMD lanes may reach
// over the picture's edge.

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "core/memory/memory_pages.h"
#include "core/memory/uninitialised_array.h"
#include "core/parallel/parallel.h"
#include "render/film/for_each_pixel.h"

namespace kaustik::render {

class Plane {
 public:
  // Pixels that may be read, and floats that may be written, beyond each side of the picture. The right side
  // holds a whole tile more (regression.cpp).
  static constexpr int kBorder = 8, kRightBorder = 64;

  Plane() = default;
  Plane(int width, int height)
      : width_(width),
        height_(height),
        stride_(size_t(width) + kBorder + kRightBorder),
        values_(stride_ * (size_t(height) + 2 * kBorder)) {
    prefer_large_pages(values_.data(), values_.size() * sizeof(float));
    parallel::for_index(0, height + 2 * kBorder, [&](int row) {
      std::fill_n(values_.begin() + std::ptrdiff_t(size_t(row) * stride_), stride_, 0.0f);
    });
  }
  int width() const { return width_; }
  int height() const { return height_; }
  float& at(int x, int y) { return values_[index(x, y)]; }
  float at(int x, int y) const { return values_[index(x, y)]; }
  // Repeats the pixels of the picture's edge in the border, kBorder of them on each side.
  void extend();
  const float* row(int x, int y) const { return &values_[index(x, y)]; }

 private:
  size_t index(int x, int y) const { return size_t(y + kBorder) * stride_ + size_t(x + kBorder); }

  int width_ = 0, height_ = 0;
  size_t stride_ = 0;
  std::vector<float, UninitialisedAllocator<float>> values_;
};

// The planes of red, green and blue.
using ColourPlanes = std::array<Plane, 3>;

// A plane of value(x, y).
template <class Value>
Plane plane_of(int width, int height, const Value& value) {
  Plane plane(width, height);
  for_each_pixel(width, height, [&](int x, int y) { plane.at(x, y) = value(x, y); });
  return plane;
}

// Means over squares of 2 radius + 1 pixels a side, cut at the picture's edge. radius <= kBorder.
Plane blurred(const Plane& plane, int radius);

}  // namespace kaustik::render
