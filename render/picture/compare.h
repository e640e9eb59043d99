#pragma once
// Difference between an image and a reference.

#include <array>
#include <cstdint>
#include <optional>

#include "render/picture/image.h"

namespace kaustik::render {

// Sides in pixels of the blocks over which compare() takes means: pictures of pixels that are up to 8 times
// coarser.
inline constexpr std::array<int, 4> kBlockSides = {1, 2, 4, 8};

struct CompareOptions {
  // Leaves out all pixels within 2 pixels (a 5 x 5 square, cut at the image's border) of reference pixels
  // whose largest channel exceeds this radiance, such as edges of emitters and of their mirror images.
  std::optional<float> mask_bright;
};

// All means are over the compared pixels (not masked, finite in both pictures) and their three channels,
// computed in double precision.
struct CompareResult {
  uint64_t compared = 0;                      // pixels
  uint64_t masked = 0;                        // pixels left out by mask_bright
  uint64_t nan_image = 0, nan_reference = 0;  // pixels with a NaN or infinite channel, left out of the means
  double rmse = 0;                            // sqrt(mean (I - R)^2)
  double relmse = 0;                          // mean (I - R)^2 / (R^2 + 0.01)
  // relMSE of the means over blocks of k x k pixels, for each k of kBlockSides; the first is relmse. Blocks
  // are counted from the upper left corner and cut at the border; only their compared pixels enter their
  // means, and a block weighs as much as it has compared pixels. Noise of independent samples falls by k^2,
  // while blotches wider than a block stay as they are.
  std::array<double, kBlockSides.size()> relmse_of_blocks{};
  // 20 log10(peak / rmse), dB; peak = largest compared reference channel; infinite where rmse is 0
  double psnr = 0;
  double max_difference = 0;  // largest |I - R|
  int max_x = 0, max_y = 0, max_channel = 0;
  double mean_image = 0, mean_reference = 0;
};

// Throws std::invalid_argument when the sizes differ or either picture is empty.
CompareResult compare(const Image& reference, const Image& image, const CompareOptions& options = {});

// True for each pixel of the reference that the options leave out.
std::vector<bool> masked_pixels(const Image& reference, const CompareOptions& options);

// Returns (value - reference)^2 / (reference^2 + 0.01), for one channel.
double relative_squared(double value, double reference);

// Relative squared error of each pixel (mean over channels) as a grey image. Throws as compare() does.
Image relative_error(const Image& reference, const Image& image);

// Maps errors to colours on a logarithmic scale from 1e-4: 0 is black, then blue, red, yellow, and white from
// 1 on; NaN is magenta. Linear values for write_image() with the default tone settings.
Image false_colours(const Image& error);

// Returns false_colours(relative_error(reference, image)).
Image heatmap(const Image& reference, const Image& image);

}  // namespace kaustik::render
