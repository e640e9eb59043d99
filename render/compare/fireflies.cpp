#include "render/compare/fireflies.h"

#include <algorithm>
#include <array>

namespace kaustik::render {

namespace {

constexpr double kFactor = 10, kLeastMedian = 0.01, kAboveReference = 2;

double luminance_at(const Image& image, int x, int y) {
  return double(luminance(image.at(x, y)));
}

// The median of 5 x 5 pixels, the lower one of an even number. Pixels that are not finite count as black.
double median_about(const Image& image, int x, int y) {
  constexpr int kReach = 2;
  std::array<double, (2 * kReach + 1) * (2 * kReach + 1)> found;
  size_t count = 0;
  for (int v = std::max(0, y - kReach); v <= std::min(image.height - 1, y + kReach); ++v)
    for (int u = std::max(0, x - kReach); u <= std::min(image.width - 1, x + kReach); ++u)
      found[count++] = is_finite(image.at(u, v)) ? luminance_at(image, u, v) : 0;
  const auto middle = found.begin() + std::ptrdiff_t((count - 1) / 2);
  std::nth_element(found.begin(), middle, found.begin() + std::ptrdiff_t(count));
  return *middle;
}

}  // namespace

Fireflies find_fireflies(const Image& reference, const Image& image, const CompareOptions& options) {
  const std::vector<bool> compared = compared_pixels(reference, image, options);
  double mean = 0, pixels = 0;
  for (size_t i = 0; i < compared.size(); ++i)
    if (compared[i]) mean += double(luminance(reference.pixels[i])), ++pixels;
  const double least = kLeastMedian * std::max(mean, 0.0) / std::max(pixels, 1.0);
  Fireflies out;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      if (!compared[size_t(y) * size_t(image.width) + size_t(x)]) continue;
      const double here = luminance_at(image, x, y), wanted = luminance_at(reference, x, y);
      if (!(here > kFactor * least) || !(here > kAboveReference * wanted)) continue;
      if (!(here > kFactor * median_about(image, x, y))) continue;
      ++out.count;
      if (here > out.image) out.x = x, out.y = y, out.image = here, out.reference = wanted;
    }
  return out;
}

}  // namespace kaustik::render
