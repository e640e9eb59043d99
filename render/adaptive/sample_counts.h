#pragma once
// Adaptive sample counts: pixels whose first samples vary more take more samples.
//
// Half a block of rays (BlockPart) is judged by its neighbours: the block's other half and the surrounding
// blocks. Given the photons, samples of different pixels are independent, so the number of a pixel's samples
// does not depend on their values, and their mean is unbiased. If pixels were judged by their own first
// samples, those that came out too dark would be left alone too often (Kirk and Arvo 1991, "Unbiased Sampling
// Techniques for Image Synthesis").

#include <cstdint>
#include <vector>

#include "render/adaptive/sample_spread.h"
#include "render/camera/camera_rays.h"
#include "render/film/film.h"

namespace kaustik::render {

// A pixel takes at most 2^6 times as many samples as its first ones.
inline constexpr int kMostDoublings = 6;

class SampleCounts {
 public:
  // Prepares the blocks that this window touches, counted from the corner of the full image.
  explicit SampleCounts(const FilmSums& window);

  // Statistics of one half of the block that contains pixel (x, y) of the full image. Different halves may be
  // set by different threads.
  SampleSpread& spread(int x, int y, int half) { return spreads_[index(x, y, half)]; }

  // Chooses the counts, once all spreads are set. Counts are 2^k first; the samples beyond the first ones
  // together take at most `adaptive_work` times the work of the first. Counts follow the fourth root of
  // variance / (work (mean^2 + m^2)), where m^2 keeps dim pixels from taking all samples; the ratio is that
  // of all light or of traced light, whichever is larger. Where the limit of k is reached, less work is done.
  // Later calls must allow no less work; no count then falls.
  void choose_counts(uint64_t first, double adaptive_work);

  uint64_t count(int x, int y, int half) const { return counts_[index(x, y, half)]; }
  // The count that the previous call of choose_counts() chose; `first` after the first call.
  uint64_t count_before(int x, int y, int half) const { return counts_before_[index(x, y, half)]; }
  // Which light the samples beyond the first ones compute.
  SampleLight light(int x, int y, int half) const { return lights_[index(x, y, half)]; }

 private:
  size_t index(int x, int y, int half) const {
    return block(x / kRayBlock - first_column_, y / kRayBlock - first_row_) + size_t(half);
  }
  // Index of the first half of a block in the window.
  size_t block(int column, int row) const {
    return (size_t(row) * size_t(columns_) + size_t(column)) * kHalves;
  }
  SampleSpread neighbours(size_t i) const;

  int first_column_, first_row_, columns_, rows_;
  std::vector<SampleSpread> spreads_;
  std::vector<uint64_t> counts_, counts_before_;
  std::vector<SampleLight> lights_;
};

}  // namespace kaustik::render
