#pragma once
// Discrete distributions.

#include <cstdint>
#include <vector>

#include "core/math/vec.h"

namespace kaustik {

// Samples indices in proportion to non-negative weights, by inversion of their cumulative sum (held in
// double).
class DiscreteDistribution {
 public:
  DiscreteDistribution() = default;
  explicit DiscreteDistribution(const std::vector<double>& weights);

  struct Sample {
    uint32_t index;
    float pdf;         // probability of index
    float u_remapped;  // what is left of the random number, again uniform in [0, 1)
  };
  // u in [0, 1). Requires !empty() and total() > 0. An entry of weight zero is never chosen.
  Sample sample(float u) const;
  float pdf(uint32_t index) const;
  double total() const { return total_; }
  bool empty() const { return cdf_.empty(); }
  size_t size() const { return cdf_.size(); }

 private:
  size_t first_above(double u) const;  // index of the first cdf_ entry above u
  std::vector<double> cdf_;            // cdf_[i] = sum of weights 0..i, divided by total_
  double total_ = 0;
};

}  // namespace kaustik
