#include "render/picture/exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace kaustik::render {

namespace {

constexpr double kMiddleGrey = 0.18;
constexpr double kBrightest = 0.01;  // the share of the pixels that is left out as too bright
constexpr double kBright = 0.05;     // the share of the pixels that sets what is dark beside it
constexpr double kDarkStops = 8;     // so far below these, a pixel is shown as black or nearly so

// The radiance that `tonemap` shows as middle grey.
double radiance_of_grey(Tonemap tonemap) {
  switch (tonemap) {
    case Tonemap::kReinhard:
      return kMiddleGrey / (1 - kMiddleGrey);
    case Tonemap::kFilmic:
      return before_filmic(kMiddleGrey);
    case Tonemap::kSrgb:
      break;
  }
  return kMiddleGrey;
}

// The value that a share of the sorted values reaches.
double reached_by(const std::vector<float>& sorted, double share) {
  const size_t above = static_cast<size_t>(share * double(sorted.size()));
  return double(sorted[sorted.size() - 1 - std::min(above, sorted.size() - 1)]);
}

// The exposure for these luminances, all of them finite and above 0.
float exposure_for(std::vector<float> luminances, Tonemap tonemap) {
  if (luminances.empty()) return 0;
  std::sort(luminances.begin(), luminances.end());
  const double most = reached_by(luminances, kBrightest);
  const double least = reached_by(luminances, kBright) * std::exp2(-kDarkStops);
  double sum = 0;
  size_t count = 0;
  for (const float Y : luminances) {
    if (double(Y) < least || double(Y) > most) continue;
    sum += std::log2(double(Y));
    ++count;
  }
  const double stops = std::log2(radiance_of_grey(tonemap)) - sum / double(count);
  return float(std::round(std::clamp(stops, double(-kMostStops), double(kMostStops)) * 100) / 100);
}

// The luminances of the pixels for which metered(x, y), without those that are no light.
template <class Metered>
std::vector<float> luminances_of(const Image& picture, const Metered& metered) {
  std::vector<float> luminances;
  luminances.reserve(picture.pixels.size());
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const float Y = luminance(picture.at(x, y));
      if (std::isfinite(Y) && Y > 0 && metered(x, y)) luminances.push_back(Y);
    }
  return luminances;
}

// Whether a pixel's radiance is mostly that of a light which the camera sees directly.
bool shows_light(const PixelResult& pixel) {
  return luminance(pixel.emitted - pixel.denoising_emitted) > 0.5f * luminance(pixel.radiance());
}

}  // namespace

float automatic_exposure(const Image& picture, Tonemap tonemap) {
  return exposure_for(luminances_of(picture, [](int, int) { return true; }), tonemap);
}

float automatic_exposure(const Image& picture, const Film& film, Tonemap tonemap) {
  std::vector<float> luminances =
      luminances_of(picture, [&](int x, int y) { return !shows_light(film.at(x, y)); });
  return luminances.empty() ? automatic_exposure(picture, tonemap)
                            : exposure_for(std::move(luminances), tonemap);
}

}  // namespace kaustik::render
