#include "render/picture/exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace kaustik::render {

namespace {

constexpr double kMiddleGrey = 0.18;
constexpr int kBlock = 4;            // pixels a side
constexpr double kBrightest = 0.01;  // the share of the blocks that is left out as too bright
constexpr double kBright = 0.05;     // the share of the blocks that sets what is dark beside it
constexpr double kDarkStops = 8;     // so far below these, a block is shown as black or nearly so

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

// Whether a pixel's luminance Y is mostly that of a light which the camera sees directly.
bool shows_light(const Image& lights, int x, int y, float Y) {
  return !lights.pixels.empty() && luminance(lights.at(x, y)) > 0.5f * Y;
}

// The mean luminance of a block's metered pixels; 0 or less if it is no light.
float mean_luminance(const Image& picture, const Image& lights, int x0, int y0) {
  double sum = 0;
  int count = 0;
  for (int y = y0; y < std::min(y0 + kBlock, picture.height); ++y)
    for (int x = x0; x < std::min(x0 + kBlock, picture.width); ++x) {
      const float Y = luminance(picture.at(x, y));
      if (!std::isfinite(Y) || shows_light(lights, x, y, Y)) continue;
      sum += double(Y);
      ++count;
    }
  return float(sum / std::max(count, 1));
}

// The mean luminances of the blocks, without those that are no light.
std::vector<float> luminances_of(const Image& picture, const Image& lights) {
  std::vector<float> luminances;
  luminances.reserve(picture.pixels.size() / (kBlock * kBlock) + 1);
  for (int y = 0; y < picture.height; y += kBlock)
    for (int x = 0; x < picture.width; x += kBlock)
      if (const float Y = mean_luminance(picture, lights, x, y); std::isfinite(Y) && Y > 0)
        luminances.push_back(Y);
  return luminances;
}

}  // namespace

Image lights_seen(const Film& film) {
  Image lights(film.width(), film.height());
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      lights.at(x, y) = film.at(x, y).emitted - film.at(x, y).denoising_emitted;
  return lights;
}

Image lights_seen(const ExrChannels& file) {
  Image lights(file.width, file.height);
  for (int c = 0; c < 3; ++c) {
    const std::vector<float>* const all = file.find(std::string("emitted.") + "RGB"[c]);
    const std::vector<float>* const shown = file.find(std::string("denoising_emitted.") + "RGB"[c]);
    if (!all || !shown) return {};
    for (size_t i = 0; i < lights.pixels.size(); ++i) lights.pixels[i][c] = (*all)[i] - (*shown)[i];
  }
  return lights;
}

float automatic_exposure(const Image& picture, const Image& lights, Tonemap tonemap) {
  std::vector<float> luminances = luminances_of(picture, lights);
  if (luminances.empty()) luminances = luminances_of(picture, {});
  return exposure_for(std::move(luminances), tonemap);
}

}  // namespace kaustik::render
