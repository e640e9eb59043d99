// Finds the threshold of relative variance at which the adaptive samples take the allowed work.

#include "render/adaptive/sample_counts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace kaustik::render {

namespace {

// Relative variances are binned by their logarithm: the upper bits of a float, which are ordered like its
// value.
constexpr int kMantissaBits = 4;
constexpr uint32_t kSteps = 1u << (8 + kMantissaBits);  // bins for all finite non-negative floats
// Bins for each doubling of the count. If the variance of a mean fell like 1 / count, the count should follow
// the root of the relative variance; for stratified samples it falls faster, and smooth pixels gain as much
// from a few samples as edges do from many.
constexpr int kStepsPerDoubling = 4 << kMantissaBits;
uint32_t step_of(double relative_variance) {
  const float value = static_cast<float>(std::min(relative_variance, 1e30));
  return value > 0 ? std::bit_cast<uint32_t>(value) >> (23 - kMantissaBits) : 0;
}

int doublings(uint32_t step, uint32_t threshold) {
  return std::clamp((int(step) - int(threshold)) / kStepsPerDoubling, 0, kMostDoublings);
}

// Work of the pixels in each bin, for as many samples as the first ones.
using Histogram = std::array<double, kSteps>;

double adaptive_work_of(const Histogram& work, uint32_t threshold) {
  double sum = 0;
  for (uint32_t step = 0; step < kSteps; ++step)
    if (work[step] > 0) sum += work[step] * (std::ldexp(1.0, doublings(step, threshold)) - 1);
  return sum;
}

// Lowest threshold whose adaptive samples take at most `most` work.
uint32_t least_threshold(const Histogram& work, double most) {
  uint32_t low = 1, high = kSteps;
  while (low < high) {
    const uint32_t middle = low + (high - low) / 2;
    if (adaptive_work_of(work, middle) <= most)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

double gain_of(const LightSpread& light) {
  return light.work > 0 ? light.variance / light.work : 0;
}

}  // namespace

SampleCounts::SampleCounts(const FilmSums& window)
    : first_column_(window.x0() / kRayBlock),
      first_row_(window.y0() / kRayBlock),
      columns_((window.x0() + window.width() - 1) / kRayBlock + 1 - first_column_),
      rows_((window.y0() + window.height() - 1) / kRayBlock + 1 - first_row_),
      spreads_(size_t(columns_) * size_t(rows_) * kHalves),
      counts_(spreads_.size()),
      lights_(spreads_.size()) {}

// Sum over the neighbours of half block i. The other half weighs as much as all surrounding blocks together:
// it is smaller but nearer.
SampleSpread SampleCounts::neighbours(size_t i) const {
  constexpr double kAround = 1.0 / 16;
  const int half = int(i % kHalves), column = int(i / kHalves) % columns_, row = int(i / kHalves) / columns_;
  SampleSpread sum;
  for (int r = std::max(row - 1, 0); r <= std::min(row + 1, rows_ - 1); ++r) {
    for (int c = std::max(column - 1, 0); c <= std::min(column + 1, columns_ - 1); ++c) {
      const SampleSpread* const halves = &spreads_[block(c, r)];
      if (r == row && c == column)
        sum.add(halves[1 - half], 1);
      else
        for (int h = 0; h < kHalves; ++h) sum.add(halves[h], kAround);
    }
  }
  return sum;
}

void SampleCounts::choose_counts(uint64_t first, double adaptive_work) {
  SampleSpread all;
  double roots = 0;
  for (const SampleSpread& half : spreads_) {
    all.add(half, 1);
    if (half.pixels > 0) roots += std::sqrt(std::max(half.mean * half.pixels, 0.0));
  }
  counts_before_ = counts_;
  if (counts_before_.front() == 0) std::ranges::fill(counts_before_, first);
  if (!(all.pixels > 0)) return;
  const double root = roots / all.pixels, least = root * root / 2;

  std::vector<uint32_t> steps(spreads_.size());
  Histogram work{};
  for (size_t i = 0; i < steps.size(); ++i) {
    const SampleSpread near = neighbours(i);
    if (!(near.pixels > 0)) continue;
    const double whole = gain_of(near.of(SampleLight::kAll)), traced = gain_of(near.of(SampleLight::kTraced));
    const double m = near.mean / near.pixels;
    lights_[i] = whole < traced ? SampleLight::kTraced : SampleLight::kAll;
    steps[i] = step_of(std::max(whole, traced) / (m * m + least * least));
    work[steps[i]] += spreads_[i].of(lights_[i]).work;
  }
  const uint32_t threshold = least_threshold(work, all.of(SampleLight::kAll).work * adaptive_work);
  for (size_t i = 0; i < counts_.size(); ++i) counts_[i] = first << doublings(steps[i], threshold);
}

}  // namespace kaustik::render
