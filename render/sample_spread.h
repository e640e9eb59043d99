#pragma once
// How much the samples of a pixel differ.

#include <array>
#include <cstdint>

#include "core/math/vec.h"
#include "render/camera_rays.h"

namespace kaustik::render {

// Moments of the samples of one pixel, W/(m^2 sr), and what they cost: rays and readings of a map.
struct SampleMoments {
  glm::dvec3 sum{0}, squares{0};
  uint64_t count = 0, work = 0;

  void add(const Rgb& radiance, uint64_t its_work) {
    const glm::dvec3 x(radiance);
    sum += x, squares += x * x;
    ++count, work += its_work;
  }
};

// Of a block of rays, by pixel_of_block(). Pixels outside the window have no samples.
using BlockMoments = std::array<SampleMoments, kRayBlock * kRayBlock>;

// What some samples of some pixels say: sums over the pixels.
struct SampleSpread {
  double variance = 0;  // of one sample: the sum over R, G and B, (W/(m^2 sr))^2
  double mean = 0;      // of R, G and B, W/(m^2 sr)
  double work = 0;      // of one sample
  double pixels = 0;

  void add(const SampleSpread& other, double weight) {
    variance += weight * other.variance, mean += weight * other.mean;
    work += weight * other.work, pixels += weight * other.pixels;
  }
};

// Of half a block (0 or 1, see half_of()). The samples of a pixel are stratified, so that their mean varies
// less than their own variance says; and the means of neighbours vary by that, and by what there is to see.
// The smaller of the two is taken, from the means' distance to a plane; at the border of the window the
// first.
SampleSpread spread_of(const BlockMoments& block, int half);

}  // namespace kaustik::render
