#pragma once
// How much the samples of a pixel differ.

#include <array>
#include <cstdint>

#include "core/math/vec.h"
#include "render/camera/camera_rays.h"
#include "render/film/film.h"

namespace kaustik::render {

// Of some light of the samples of one pixel, W/(m^2 sr), and of what it costs: rays and readings of a map.
struct LightMoments {
  glm::dvec3 sum{0}, squares{0};
  uint64_t work = 0;

  void add(const Rgb& radiance, uint64_t its_work) {
    const glm::dvec3 x(radiance);
    sum += x, squares += x * x;
    work += its_work;
  }
};

// Of the samples of one pixel.
struct SampleMoments {
  std::array<LightMoments, kSampleLights> light;  // by SampleLight
  uint64_t count = 0;
};

// Of a block of rays, by pixel_of_block(). Pixels outside the window have no samples.
using BlockMoments = std::array<SampleMoments, kRayBlock * kRayBlock>;

// What some samples of some pixels say of some light: sums over the pixels, of one sample each.
struct LightSpread {
  double variance = 0;  // the sum over R, G and B, (W/(m^2 sr))^2
  double work = 0;

  void add(const LightSpread& other, double weight) {
    variance += weight * other.variance, work += weight * other.work;
  }
};

// The same of all light.
struct SampleSpread {
  std::array<LightSpread, kSampleLights> light;  // by SampleLight
  double mean = 0;                               // of all light, of R, G and B, W/(m^2 sr)
  double pixels = 0;

  void add(const SampleSpread& other, double weight) {
    for (size_t i = 0; i < light.size(); ++i) light[i].add(other.light[i], weight);
    mean += weight * other.mean, pixels += weight * other.pixels;
  }
  const LightSpread& of(SampleLight which) const { return light[size_t(which)]; }
};

// Of half a block (0 or 1, see half_of()). The samples of a pixel are stratified, so that their mean varies
// less than their own variance says; and the means of neighbours vary by that, and by what there is to see.
// The smaller of the two is taken, from the means' distance to a plane; at the border of the window the
// first.
SampleSpread spread_of(const BlockMoments& block, int half);

}  // namespace kaustik::render
