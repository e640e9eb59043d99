#include "render/denoise/plane.h"

#include <algorithm>

#include "core/parallel/parallel.h"

namespace kaustik::render {

namespace {

// The number of pixels within `radius` of pixel `at` in a row of `size`.
int reached(int at, int radius, int size) {
  return std::min(at + radius, size - 1) - std::max(at - radius, 0) + 1;
}

}  // namespace

void Plane::extend() {
  for (int y = 0; y < height_; ++y)
    for (int i = 1; i <= kBorder; ++i) at(-i, y) = at(0, y), at(width_ - 1 + i, y) = at(width_ - 1, y);
  for (int i = 1; i <= kBorder; ++i)
    for (int x = -kBorder; x < width_ + kBorder; ++x)
      at(x, -i) = at(x, 0), at(x, height_ - 1 + i) = at(x, height_ - 1);
}

Plane blurred(const Plane& plane, int radius) {
  const int width = plane.width(), height = plane.height();
  Plane columns(width, height), out(width, height);
  parallel::for_index(0, height, [&](int y) {
    for (int v = -radius; v <= radius; ++v)
      for (int x = 0; x < width; ++x) columns.at(x, y) += plane.at(x, y + v);
  });
  parallel::for_index(0, height, [&](int y) {
    for (int u = -radius; u <= radius; ++u)
      for (int x = 0; x < width; ++x) out.at(x, y) += columns.at(x + u, y);
    for (int x = 0; x < width; ++x)
      out.at(x, y) /= float(reached(x, radius, width) * reached(y, radius, height));
  });
  return out;
}

}  // namespace kaustik::render
