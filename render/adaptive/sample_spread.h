#pragma once
// How much the samples of a pixel vary, and what they cost.

#include <array>
#include <cstdint>

#include "core/math/vec.h"
#include "render/camera/camera_rays.h"
#include "render/film/film.h"

namespace kaustik::render {

// Moments of one SampleLight over a pixel's samples, in W/(m^2 sr), and their cost: rays plus gathers.
struct LightMoments {
  glm::dvec3 sum{0}, squares{0};
  uint64_t work = 0;

  void add(const Rgb& radiance, uint64_t its_work) {
    const glm::dvec3 x(radiance);
    sum += x, squares += x * x;
    work += its_work;
  }
};

// Moments of all samples of one pixel.
struct SampleMoments {
  std::array<LightMoments, kSampleLights> light;  // by SampleLight
  uint64_t count = 0;
};

// Moments of a block of rays, indexed by pixel_of_block(). Pixels outside the window have no samples.
using BlockMoments = std::array<SampleMoments, kRayBlock * kRayBlock>;

// Variance and work of one sample, summed over some pixels.
struct LightSpread {
  double variance = 0;  // the sum over R, G and B, (W/(m^2 sr))^2
  double work = 0;

  void add(const LightSpread& other, double weight) {
    variance += weight * other.variance, work += weight * other.work;
  }
};

// LightSpread for each SampleLight, and the mean of all light.
struct SampleSpread {
  std::array<LightSpread, kSampleLights> light;  // by SampleLight
  double mean = 0;                               // all light, mean of R, G and B, W/(m^2 sr)
  double pixels = 0;

  void add(const SampleSpread& other, double weight) {
    for (size_t i = 0; i < light.size(); ++i) light[i].add(other.light[i], weight);
    mean += weight * other.mean, pixels += weight * other.pixels;
  }
  const LightSpread& of(SampleLight which) const { return light[size_t(which)]; }
};

// Statistics of half a block (0 or 1, see half_of()). Two bounds of a sample's variance are known: the
// samples' own variance is too large, because the samples of a pixel are stratified; the variance of the
// pixels' means about a plane contains image detail too. The smaller one is used; at the border of the
// window, where pixels are missing, the first.
SampleSpread spread_of(const BlockMoments& block, int half);

}  // namespace kaustik::render
