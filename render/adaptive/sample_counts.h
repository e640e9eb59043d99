#pragma once
// How many samples each pixel takes where they are not spent evenly: more where the first few differ.
//
// Half a block of rays (BlockPart) is judged by its neighbours: the block's other half, and the blocks
// around. Given the photons, samples of different pixels are independent, so that the number of a pixel's
// samples does not depend on what they bring, and their mean is unbiased. Judged by its own first samples, a
// pixel would be left alone more often the darker they came out (Kirk and Arvo 1991, "Unbiased Sampling
// Techniques for Image Synthesis").

#include <cstdint>
#include <vector>

#include "render/adaptive/sample_spread.h"
#include "render/camera/camera_rays.h"
#include "render/film/film.h"

namespace kaustik::render {

// The number of a pixel's samples is at most 2^6 times that of the first.
inline constexpr int kMostDoublings = 6;

class SampleCounts {
 public:
  // For the blocks that this window touches, counted from the corner of the full image.
  explicit SampleCounts(const FilmSums& window);

  // Half of the block that pixel (x, y) of the full image lies in. Different halves may be set by different
  // threads.
  SampleSpread& spread(int x, int y, int half) { return spreads_[index(x, y, half)]; }

  // Once all spreads are set: counts of 2^k first, of which those beyond the first together take at most
  // `further_work` times the work of the first. They follow the fourth root of
  // variance / (work (mean^2 + m^2)), where m^2 keeps dim pixels from taking all; of all light or of traced
  // light, whichever is more. Less is done where the limit of k is met.
  void share_out(uint64_t first, double further_work);

  uint64_t count(int x, int y, int half) const { return counts_[index(x, y, half)]; }
  // What the samples beyond the first are to bring.
  SampleLight light(int x, int y, int half) const { return lights_[index(x, y, half)]; }

 private:
  size_t index(int x, int y, int half) const {
    return block(x / kRayBlock - first_column_, y / kRayBlock - first_row_) + size_t(half);
  }
  // Where the halves of a block of the window begin.
  size_t block(int column, int row) const {
    return (size_t(row) * size_t(columns_) + size_t(column)) * kHalves;
  }
  SampleSpread neighbours(size_t i) const;

  int first_column_, first_row_, columns_, rows_;
  std::vector<SampleSpread> spreads_;
  std::vector<uint64_t> counts_;
  std::vector<SampleLight> lights_;
};

}  // namespace kaustik::render
