#pragma once
// CPU time of work, and medians, for rivals that take turns in one run.

#include <algorithm>
#include <ctime>
#include <vector>

namespace kaustik::benchmarks {

// CPU time of the whole process for this work, which other load of the machine hardly changes.
template <class Work>
double cpu_seconds(const Work& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

// The median; for an even number of values the upper of the two in the middle. v is not empty.
inline double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<long>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

}  // namespace kaustik::benchmarks
