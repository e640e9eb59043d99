#pragma once
// Mean and standard error of random quantities.

#include <cmath>
#include <cstdint>
#include <vector>

namespace kaustik::test {

struct Estimate {
  double mean = 0, standard_error = 0;
};

// Running mean and variance (Welford 1962).
struct Mean {
  double mean = 0, m2 = 0;
  int64_t count = 0;

  void add(double x) {
    ++count;
    const double delta = x - mean;
    mean += delta / static_cast<double>(count);
    m2 += delta * (x - mean);
  }
  // Standard error of the mean; needs two values.
  double standard_error() const {
    return std::sqrt(m2 / (static_cast<double>(count) * static_cast<double>(count - 1)));
  }
  Estimate estimate() const { return {mean, standard_error()}; }
};

inline Estimate estimate_of(const std::vector<double>& values) {
  Mean mean;
  for (const double value : values) mean.add(value);
  return mean.estimate();
}

}  // namespace kaustik::test
