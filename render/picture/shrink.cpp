// Box filter along one axis at a time.

#include "render/picture/shrink.h"

#include <algorithm>
#include <cmath>

namespace kaustik::render {

namespace {

// Shrinks along x and transposes; applied twice it shrinks in both directions.
Image shrunk_and_turned(const Image& image, int width) {
  Image out(image.height, width);
  const double step = double(image.width) / width;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < width; ++x) {
      const double begin = x * step, end = std::min((x + 1) * step, double(image.width));
      glm::dvec3 sum(0);
      for (int u = int(begin); u < image.width && u < end; ++u)
        sum += glm::dvec3(image.at(u, y)) * (std::min(end, u + 1.0) - std::max(begin, double(u)));
      out.at(y, x) = Rgb(sum / (end - begin));
    }
  return out;
}

}  // namespace

Image shrunk(const Image& image, int longest) {
  const int side = std::max(image.width, image.height);
  if (side <= longest) return image;
  const auto scaled = [&](int n) {
    return std::max(1, static_cast<int>(std::lround(double(n) * longest / side)));
  };
  return shrunk_to(image, scaled(image.width), scaled(image.height));
}

Image shrunk_to(const Image& image, int width, int height) {
  if (width == image.width && height == image.height) return image;
  return shrunk_and_turned(shrunk_and_turned(image, width), height);
}

}  // namespace kaustik::render
