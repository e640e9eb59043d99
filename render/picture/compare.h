#pragma once
// How far an image is from a reference.

#include <cstdint>
#include <optional>

#include "render/picture/image.h"

namespace kaustik::render {

struct CompareOptions {
  // Leaves out the pixels within 2 pixels (a 5 x 5 square, cut at the image's border) of reference pixels
  // whose largest channel is above this radiance: edges of emitters and of their mirror images.
  std::optional<float> mask_bright;
};

// All means run over the compared pixels (not masked, both pictures finite) and their three channels, in
// double.
struct CompareResult {
  uint64_t compared = 0;                      // pixels
  uint64_t masked = 0;                        // pixels left out by mask_bright
  uint64_t nan_image = 0, nan_reference = 0;  // pixels with a NaN or infinite channel: left out of the means
  double rmse = 0;                            // sqrt(mean (I - R)^2)
  double relmse = 0;                          // mean (I - R)^2 / (R^2 + 0.01)
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

// (value - reference)^2 / (reference^2 + 0.01) of one channel.
double relative_squared(double value, double reference);

// Per-pixel relative squared error (mean over channels), grey. Throws as compare does.
Image relative_error(const Image& reference, const Image& image);

// Such an error as a colour: black 0, then blue, red, yellow, white at 1 and above, on a logarithmic scale
// from 1e-4; NaN pixels are magenta. Linear values for write_image with the default tone settings.
Image false_colours(const Image& error);

// false_colours of relative_error.
Image heatmap(const Image& reference, const Image& image);

}  // namespace kaustik::render
