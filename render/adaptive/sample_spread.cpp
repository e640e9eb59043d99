// Variance of samples from their moments, and of pixel means about a plane.

#include "render/adaptive/sample_spread.h"

#include <algorithm>
#include <cmath>

namespace kaustik::render {

namespace {

double sum_of(const glm::dvec3& v) {
  return v.x + v.y + v.z;
}

// Infinite where a single sample leaves the variance unknown.
double variance_of(const LightMoments& light, uint64_t count) {
  if (count < 2) return kInfinity;
  const double n = double(count);
  return std::max(sum_of(light.squares - light.sum * light.sum / n) / (n - 1), 0.0);
}

// Position of pixel i in its block, relative to the centre.
glm::dvec2 place(int i) {
  constexpr double kMiddle = (kRayBlock - 1) / 2.0;
  return {i % kRayBlock - kMiddle, i / kRayBlock - kMiddle};
}

bool in_half(int i, int half) {
  return half_of(i % kRayBlock, i / kRayBlock) == half;
}

// Variance of the pixels' means about the plane that fits them best. All pixels of the half must have
// samples.
double variance_about_plane(const BlockMoments& block, int half, size_t light) {
  constexpr double kPixels = pixels_in(BlockPart::kEven), kFreedom = kPixels - 3;
  glm::dvec3 sum(0), squares(0), along_x(0), along_y(0);
  double xx = 0, xy = 0;  // yy equals xx; the sums of x and of y are 0
  for (int i = 0; i < int(block.size()); ++i) {
    if (!in_half(i, half)) continue;
    const SampleMoments& pixel = block[size_t(i)];
    const glm::dvec2 at = place(i);
    const glm::dvec3 mean = pixel.light[light].sum / double(pixel.count);
    sum += mean, squares += mean * mean, along_x += at.x * mean, along_y += at.y * mean;
    xx += at.x * at.x, xy += at.x * at.y;
  }
  const double determinant = xx * xx - xy * xy;
  const glm::dvec3 slope_x = (xx * along_x - xy * along_y) / determinant,
                   slope_y = (xx * along_y - xy * along_x) / determinant;
  const glm::dvec3 rest = squares - sum * sum / kPixels - slope_x * along_x - slope_y * along_y;
  return std::max(sum_of(rest) / kFreedom, 0.0);
}

LightSpread spread_of(const BlockMoments& block, int half, size_t light) {
  LightSpread spread;
  uint64_t fewest = ~uint64_t{0}, samples = 0;
  for (int i = 0; i < int(block.size()); ++i) {
    if (!in_half(i, half)) continue;
    const SampleMoments& pixel = block[size_t(i)];
    fewest = std::min(fewest, pixel.count), samples += pixel.count;
    if (pixel.count == 0) continue;
    spread.variance += variance_of(pixel.light[light], pixel.count);
    spread.work += double(pixel.light[light].work) / double(pixel.count);
  }
  if (fewest > 0)
    spread.variance = std::min(spread.variance, double(samples) * variance_about_plane(block, half, light));
  if (!std::isfinite(spread.variance)) spread.variance = 0;
  return spread;
}

}  // namespace

SampleSpread spread_of(const BlockMoments& block, int half) {
  SampleSpread spread;
  for (int i = 0; i < int(block.size()); ++i) {
    const SampleMoments& pixel = block[size_t(i)];
    if (!in_half(i, half) || pixel.count == 0) continue;
    spread.mean += sum_of(pixel.light[size_t(SampleLight::kAll)].sum) / (3 * double(pixel.count));
    ++spread.pixels;
  }
  for (size_t light = 0; light < spread.light.size(); ++light)
    spread.light[light] = spread_of(block, half, light);
  return spread;
}

}  // namespace kaustik::render
