// Error measures and error images.

#include "render/picture/compare.h"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

namespace kaustik::render {

namespace {

void require_same_size(const Image& reference, const Image& image) {
  if (reference.width != image.width || reference.height != image.height)
    throw std::invalid_argument(fmt::format("sizes differ: reference {} x {}, image {} x {}", reference.width,
                                            reference.height, image.width, image.height));
  if (reference.pixels.empty()) throw std::invalid_argument("the images are empty");
}

// True for the pixels to leave out.
std::vector<bool> bright_mask(const Image& reference, float threshold) {
  constexpr int kReach = 2;
  std::vector<bool> mask(reference.pixels.size(), false);
  for (int y = 0; y < reference.height; ++y)
    for (int x = 0; x < reference.width; ++x) {
      if (!(max_component(reference.at(x, y)) > threshold)) continue;
      for (int v = std::max(0, y - kReach); v <= std::min(reference.height - 1, y + kReach); ++v)
        for (int u = std::max(0, x - kReach); u <= std::min(reference.width - 1, x + kReach); ++u)
          mask[size_t(v) * size_t(reference.width) + size_t(u)] = true;
    }
  return mask;
}

struct Sums {
  double squared = 0, relative = 0, image = 0, reference = 0, peak = 0;
};

void add_pixel(const Image& reference, const Image& image, int x, int y, CompareResult* result, Sums* sums) {
  for (int c = 0; c < 3; ++c) {
    const double R = reference.at(x, y)[c], I = image.at(x, y)[c];
    sums->squared += (I - R) * (I - R);
    sums->relative += relative_squared(I, R);
    sums->image += I;
    sums->reference += R;
    sums->peak = std::max(sums->peak, R);
    if (std::abs(I - R) > result->max_difference) {
      result->max_difference = std::abs(I - R);
      result->max_x = x;
      result->max_y = y;
      result->max_channel = c;
    }
  }
  ++result->compared;
}

// Heat map colour of t in [0, 1].
Rgb heat(float t) {
  constexpr std::array<std::array<float, 3>, 5> kStops = {
      {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}};
  const float s = std::clamp(t, 0.0f, 1.0f) * (kStops.size() - 1);
  const size_t i = std::min(size_t(s), kStops.size() - 2);
  const float f = s - float(i);
  Rgb out;
  for (int c = 0; c < 3; ++c) out[c] = (1 - f) * kStops[i][size_t(c)] + f * kStops[i + 1][size_t(c)];
  return out;
}

}  // namespace

double relative_squared(double value, double reference) {
  return (value - reference) * (value - reference) / (reference * reference + 0.01);
}

std::vector<bool> masked_pixels(const Image& reference, const CompareOptions& options) {
  if (options.mask_bright) return bright_mask(reference, *options.mask_bright);
  return std::vector<bool>(reference.pixels.size(), false);
}

CompareResult compare(const Image& reference, const Image& image, const CompareOptions& options) {
  require_same_size(reference, image);
  const std::vector<bool> mask = masked_pixels(reference, options);
  CompareResult result;
  Sums sums;
  for (int y = 0; y < reference.height; ++y)
    for (int x = 0; x < reference.width; ++x) {
      const bool finite_image = is_finite(image.at(x, y)), finite_reference = is_finite(reference.at(x, y));
      result.nan_image += !finite_image;
      result.nan_reference += !finite_reference;
      if (mask[size_t(y) * size_t(reference.width) + size_t(x)])
        ++result.masked;
      else if (finite_image && finite_reference)
        add_pixel(reference, image, x, y, &result, &sums);
    }
  if (result.compared == 0) return result;
  const double count = 3.0 * double(result.compared);
  result.rmse = std::sqrt(sums.squared / count);
  result.relmse = sums.relative / count;
  result.psnr = result.rmse > 0 ? 20 * std::log10(sums.peak / result.rmse) : kInfinity;
  result.mean_image = sums.image / count;
  result.mean_reference = sums.reference / count;
  return result;
}

Image relative_error(const Image& reference, const Image& image) {
  require_same_size(reference, image);
  Image out(reference.width, reference.height);
  for (size_t i = 0; i < out.pixels.size(); ++i) {
    double error = 0;
    for (int c = 0; c < 3; ++c) error += relative_squared(image.pixels[i][c], reference.pixels[i][c]) / 3;
    out.pixels[i] = Rgb(float(error));
  }
  return out;
}

Image false_colours(const Image& error) {
  Image out(error.width, error.height);
  for (size_t i = 0; i < out.pixels.size(); ++i) {
    const float e = error.pixels[i].x;
    if (std::isnan(e))
      out.pixels[i] = Rgb(1, 0, 1);
    else
      out.pixels[i] = e > 0 ? heat(std::log10(e) / 4 + 1) : Rgb(0);
  }
  return out;
}

Image heatmap(const Image& reference, const Image& image) {
  return false_colours(relative_error(reference, image));
}

}  // namespace kaustik::render
