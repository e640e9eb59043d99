// Builds and inverts the cumulative sum of weights.

#include "core/sampling/discrete.h"

namespace kaustik {

DiscreteDistribution::DiscreteDistribution(const std::vector<double>& weights) : cdf_(weights.size()) {
  size_t last_positive = 0;
  for (size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] > 0) {
      total_ += weights[i];
      last_positive = i;
    }
    cdf_[i] = total_;
  }
  if (!(total_ > 0)) return;
  for (size_t i = 0; i < last_positive; ++i) cdf_[i] /= total_;
  // Exactly one, so that no u < 1 falls past the last entry with a positive weight.
  std::fill(cdf_.begin() + static_cast<ptrdiff_t>(last_positive), cdf_.end(), 1.0);
}

size_t DiscreteDistribution::first_above(double u) const {
  // Short tables are counted through without branches: a binary search would branch on random numbers, which
  // cannot be predicted.
  constexpr size_t kFew = 16;
  if (cdf_.size() > kFew) {
    return static_cast<size_t>(std::upper_bound(cdf_.begin(), cdf_.end(), u) - cdf_.begin());
  }
  size_t below = 0;
  for (const double c : cdf_) below += c <= u ? 1 : 0;
  return below;
}

DiscreteDistribution::Sample DiscreteDistribution::sample(float u) const {
  if (cdf_.size() == 1) return {0, 1, u};
  const size_t i = first_above(static_cast<double>(u));
  const double low = i > 0 ? cdf_[i - 1] : 0;
  const double width = cdf_[i] - low;
  const float remapped = static_cast<float>((u - low) / width);
  return {static_cast<uint32_t>(i), static_cast<float>(width), std::min(remapped, kOneMinusEpsilon)};
}

float DiscreteDistribution::pdf(uint32_t index) const {
  return static_cast<float>(index > 0 ? cdf_[index] - cdf_[index - 1] : cdf_[0]);
}

}  // namespace kaustik
