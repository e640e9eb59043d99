// Error measures and error images.

#include "render/compare/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "render/picture/colour_ramp.h"

namespace kaustik::render {

namespace {

std::string size_text(const Image& image) {
  std::string text = fmt::format("{} x {}", image.width, image.height);
  if (image.part)
    text += fmt::format(" (a part of {} x {})", image.part->full_width, image.part->full_height);
  return text;
}

void require_same_size(const Image& reference, const Image& image) {
  if (reference.width != image.width || reference.height != image.height)
    throw std::invalid_argument(
        fmt::format("sizes differ: reference {}, image {}", size_text(reference), size_text(image)));
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

struct BlockDeviation {
  double value = 0;
  int x = 0, y = 0;
  double image = 0, reference = 0;
};

// The smallest deviation that at least this share of the sorted ones does not exceed.
double quantile(const std::vector<BlockDeviation>& sorted, double share) {
  const double rank = std::ceil(share * double(sorted.size()));
  return sorted[size_t(std::max(1.0, rank)) - 1].value;
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

// The pixels that are not masked and are finite in both pictures.
std::vector<bool> finite_pixels(const Image& reference, const Image& image, std::vector<bool> mask) {
  mask.flip();
  for (size_t i = 0; i < mask.size(); ++i)
    mask[i] = mask[i] && is_finite(image.pixels[i]) && is_finite(reference.pixels[i]);
  return mask;
}

// Sums over the compared pixels of a block.
struct BlockSums {
  glm::dvec3 image{0}, reference{0};
  uint64_t pixels = 0;
};

// Calls visit(x, y, sums) for each block of side x side pixels that has compared pixels; (x, y) is its upper
// left pixel.
template <class Visit>
void for_each_block(const Image& reference, const Image& image, const std::vector<bool>& compared, int side,
                    const Visit& visit) {
  for (int y0 = 0; y0 < image.height; y0 += side)
    for (int x0 = 0; x0 < image.width; x0 += side) {
      BlockSums sums;
      for (int y = y0; y < std::min(y0 + side, image.height); ++y)
        for (int x = x0; x < std::min(x0 + side, image.width); ++x) {
          if (!compared[size_t(y) * size_t(image.width) + size_t(x)]) continue;
          sums.image += glm::dvec3(image.at(x, y));
          sums.reference += glm::dvec3(reference.at(x, y));
          ++sums.pixels;
        }
      if (sums.pixels > 0) visit(x0, y0, sums);
    }
}

double relmse_of_blocks(const Image& reference, const Image& image, const std::vector<bool>& compared,
                        int side) {
  double sum = 0;
  uint64_t pixels = 0;
  for_each_block(reference, image, compared, side, [&](int, int, const BlockSums& block) {
    const double n = double(block.pixels);
    for (int c = 0; c < 3; ++c) sum += n * relative_squared(block.image[c] / n, block.reference[c] / n);
    pixels += block.pixels;
  });
  return sum / (3.0 * double(pixels));
}

// Heat map colour of t in [0, 1].
Rgb heat(float t) {
  constexpr std::array<std::array<float, 3>, 5> kStops = {
      {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}};
  return colour_on_ramp(kStops, t);
}

}  // namespace

double relative_squared(double value, double reference) {
  return (value - reference) * (value - reference) / (reference * reference + 0.01);
}

std::vector<bool> masked_pixels(const Image& reference, const CompareOptions& options) {
  if (options.mask_from) require_same_size(reference, *options.mask_from);
  if (options.mask_bright)
    return bright_mask(options.mask_from ? *options.mask_from : reference, *options.mask_bright);
  return std::vector<bool>(reference.pixels.size(), false);
}

std::vector<bool> compared_pixels(const Image& reference, const Image& image, const CompareOptions& options) {
  require_same_size(reference, image);
  return finite_pixels(reference, image, masked_pixels(reference, options));
}

CompareResult compare(const Image& reference, const Image& image, const CompareOptions& options) {
  require_same_size(reference, image);
  const std::vector<bool> mask = masked_pixels(reference, options);
  const std::vector<bool> compared = finite_pixels(reference, image, mask);
  CompareResult result;
  Sums sums;
  for (int y = 0; y < reference.height; ++y)
    for (int x = 0; x < reference.width; ++x) {
      const size_t i = size_t(y) * size_t(reference.width) + size_t(x);
      result.nan_image += !is_finite(image.pixels[i]);
      result.nan_reference += !is_finite(reference.pixels[i]);
      result.masked += mask[i];
      if (compared[i]) add_pixel(reference, image, x, y, &result, &sums);
    }
  if (result.compared == 0) return result;
  const double count = 3.0 * double(result.compared);
  result.rmse = std::sqrt(sums.squared / count);
  result.relmse = sums.relative / count;
  result.psnr = result.rmse > 0 ? 20 * std::log10(sums.peak / result.rmse) : kInfinity;
  result.mean_image = sums.image / count;
  result.mean_reference = sums.reference / count;
  result.relmse_of_blocks[0] = result.relmse;
  for (size_t i = 1; i < kBlockSides.size(); ++i)
    result.relmse_of_blocks[i] = relmse_of_blocks(reference, image, compared, kBlockSides[i]);
  return result;
}

BlockDeviations compare_blocks(const Image& reference, const Image& image, int side,
                               const CompareOptions& options) {
  const std::vector<bool> compared = compared_pixels(reference, image, options);
  std::vector<BlockDeviation> found;
  for_each_block(reference, image, compared, side, [&](int x, int y, const BlockSums& block) {
    const double channels = 3.0 * double(block.pixels);
    const double I = (block.image.x + block.image.y + block.image.z) / channels;
    const double R = (block.reference.x + block.reference.y + block.reference.z) / channels;
    if (I != 0 || R != 0) found.push_back({R != 0 ? std::abs(I / R - 1) : kInfinity, x, y, I, R});
  });
  BlockDeviations out;
  out.blocks = found.size();
  if (found.empty()) return out;
  for (const BlockDeviation& block : found) out.mean += block.value / double(found.size());
  std::stable_sort(found.begin(), found.end(),
                   [](const BlockDeviation& a, const BlockDeviation& b) { return a.value < b.value; });
  out.median = quantile(found, 0.5);
  out.quantile95 = quantile(found, 0.95);
  const BlockDeviation& worst = found.back();
  out.largest = worst.value, out.x = worst.x, out.y = worst.y;
  out.image = worst.image, out.reference = worst.reference;
  return out;
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
