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
  // Where the reference is one layer of a picture, the whole picture: its bright pixels are meant. Of the
  // reference's size; null: the reference itself.
  const Image* mask_from = nullptr;
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

// Throws std::invalid_argument when the sizes of the pictures, mask_from among them, differ or one is empty.
CompareResult compare(const Image& reference, const Image& image, const CompareOptions& options = {});

// How far the means of blocks are from the reference's: |I / R - 1|, where I and R are the means over the
// compared pixels of a block and their channels. A block that is 0 in both pictures is left out; one that is
// 0 in the reference alone deviates by infinity.
struct BlockDeviations {
  uint64_t blocks = 0;  // those that count; the other numbers are 0 if there are none
  double mean = 0, median = 0, quantile95 = 0, largest = 0;
  int x = 0, y = 0;                 // upper left pixel of the block with the largest deviation
  double image = 0, reference = 0;  // its means
};

// The deviations of blocks of side x side pixels, side >= 1; quantiles are the smallest deviations that are
// not exceeded by the share of blocks. Throws as compare() does.
BlockDeviations compare_blocks(const Image& reference, const Image& image, int side,
                               const CompareOptions& options = {});

// True for each pixel of the reference that the options leave out.
std::vector<bool> masked_pixels(const Image& reference, const CompareOptions& options);

// True for each pixel that is not left out and is finite in both pictures. Throws as compare() does.
std::vector<bool> compared_pixels(const Image& reference, const Image& image, const CompareOptions& options);

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
