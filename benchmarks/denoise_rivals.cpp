// Rivals of `kaustik denoise`: a joint bilateral filter and NL-means, as papers describe them, of all
// classes of light together.
//
//   denoise_rivals bilateral|nl-means NOISY.exr OUT.exr
//
// NOISY.exr: by `kaustik render --denoise off --aov denoising`. Both filter windows of 11 x 11 pixels.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <string>

#include "render/denoise/denoise.h"
#include "render/denoise/noisy_picture.h"
#include "render/denoise/plane.h"
#include "render/picture/image_io.h"

namespace kaustik::render {
namespace {

constexpr int kReach = 5, kPatchReach = 2;

// What is filtered: all light but that which the first hit emits, as `kaustik denoise` has it.
Rgb seen_directly(const PixelResult& pixel) {
  return pixel.emitted - pixel.denoising_emitted;
}
Rgb filtered_part(const PixelResult& pixel) {
  return pixel.radiance() - seen_directly(pixel);
}

float squared_distance(const HalfMeans& p, const HalfMeans& q, Layer layer, size_t channels) {
  float sum = 0;
  for (size_t c = 0; c < channels; ++c) {
    const float step = p.of_all(half_of(layer) + c) - q.of_all(half_of(layer) + c);
    sum += step * step;
  }
  return sum;
}

// Weights by distance and by features (Petschnigg and others 2004; the deviations are usual ones). Colours
// are too noisy to be compared pixel by pixel.
float bilateral_weight(const NoisyPicture& in, int x, int y, int u, int v) {
  constexpr float kSpace = 2.5f, kAlbedo = 0.05f, kNormal = 0.15f, kDepth = 0.05f;
  const HalfMeans &p = in.halves.at(x, y), &q = in.halves.at(u, v);
  const float space = float((u - x) * (u - x) + (v - y) * (v - y)) / (kSpace * kSpace);
  const float depth = std::max(in.film.at(x, y).denoising_depth, 1e-6f);
  return std::exp(-0.5f *
                  (space + squared_distance(p, q, Layer::kDenoisingAlbedo, 3) / (kAlbedo * kAlbedo) +
                   squared_distance(p, q, Layer::kDenoisingNormal, 3) / (kNormal * kNormal) +
                   squared_distance(p, q, Layer::kDenoisingDepth, 1) / (depth * depth * kDepth * kDepth)));
}

// Variance of the picture's noise in each channel, from the halves, averaged over 3 x 3 pixels.
ColourPlanes variance_of(const NoisyPicture& in) {
  ColourPlanes variance;
  for (size_t c = 0; c < 3; ++c)
    variance[c] = blurred(plane_of(in.film.width(), in.film.height(),
                                   [&](int x, int y) {
                                     const HalfMeans& pixel = in.halves.at(x, y);
                                     float difference = 0;
                                     for (const Layer layer : kFilteredLight)
                                       difference += pixel.mean[0][half_of(layer) + c] -
                                                     pixel.mean[1][half_of(layer) + c];
                                     return difference * difference * pixel.share[0] * pixel.share[1];
                                   }),
                          1);
  return variance;
}

// NL-means with known variance (Rousselle and others 2012), k = 0.45.
float nl_means_weight(const NoisyPicture& in, const ColourPlanes& variance, int x, int y, int u, int v) {
  constexpr float kBandwidth = 0.45f;
  float sum = 0;
  int count = 0;
  for (int dy = -kPatchReach; dy <= kPatchReach; ++dy)
    for (int dx = -kPatchReach; dx <= kPatchReach; ++dx) {
      const auto inside = [&](int a, int b) {
        return a >= 0 && b >= 0 && a < in.film.width() && b < in.film.height();
      };
      if (!inside(x + dx, y + dy) || !inside(u + dx, v + dy)) continue;
      const Rgb step = filtered_part(in.film.at(x + dx, y + dy)) - filtered_part(in.film.at(u + dx, v + dy));
      for (size_t c = 0; c < 3; ++c, ++count) {
        const float at_p = variance[c].at(x + dx, y + dy), at_q = variance[c].at(u + dx, v + dy);
        sum += (step[int(c)] * step[int(c)] - (at_p + std::min(at_p, at_q))) /
               (1e-10f + kBandwidth * kBandwidth * (at_p + at_q));
      }
    }
  return std::exp(-std::max(0.0f, sum / float(count)));
}

Image filtered(const NoisyPicture& in, const std::function<float(int, int, int, int)>& weight) {
  Image out(in.film.width(), in.film.height());
  for_each_pixel(out.width, out.height, [&](int x, int y) {
    Rgb sum(0);
    float total = 0;
    for (int v = std::max(y - kReach, 0); v <= std::min(y + kReach, out.height - 1); ++v)
      for (int u = std::max(x - kReach, 0); u <= std::min(x + kReach, out.width - 1); ++u) {
        const float w = weight(x, y, u, v);
        sum += w * filtered_part(in.film.at(u, v));
        total += w;
      }
    out.at(x, y) = sum / total + seen_directly(in.film.at(x, y));
  });
  return out;
}

int run(const std::string& filter, const std::string& noisy, const std::string& out) {
  const NoisyPicture in = noisy_picture(read_exr_file(noisy, kMostPixelsRead));
  if (filter == "bilateral") {
    write_image(out,
                filtered(in, [&](int x, int y, int u, int v) { return bilateral_weight(in, x, y, u, v); }));
  } else {
    const ColourPlanes variance = variance_of(in);
    write_image(out, filtered(in, [&](int x, int y, int u, int v) {
                  return nl_means_weight(in, variance, x, y, u, v);
                }));
  }
  return 0;
}

}  // namespace
}  // namespace kaustik::render

int main(int argc, char** argv) {
  const std::string filter = argc == 4 ? argv[1] : "";
  if (filter != "bilateral" && filter != "nl-means") {
    std::fputs("usage: denoise_rivals bilateral|nl-means NOISY.exr OUT.exr\n", stderr);
    return 2;
  }
  try {
    return kaustik::render::run(filter, argv[2], argv[3]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "denoise_rivals: {}\n", error.what());
    return 1;
  }
}
