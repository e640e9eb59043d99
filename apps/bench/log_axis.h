#pragma once
// A logarithmic axis: the range that it shows, its ticks, and where a value lies on it.

#include <string>
#include <vector>

namespace kaustik::app {

class LogAxis {
 public:
  // Shows least to most (both above zero) with some room, and at least a factor of two. pixels: positions of
  // the ends, in either order. No ticks given: round numbers, at least two and at most eight.
  LogAxis(double least, double most, double first_pixel, double last_pixel, std::vector<double> ticks);

  double pixel(double value) const;
  const std::vector<double>& ticks() const { return ticks_; }  // those within the range, ascending

 private:
  double low_ = 1, high_ = 2;  // ends of the axis
  double first_pixel_ = 0, last_pixel_ = 1;
  std::vector<double> ticks_;
};

// 1500000 as "1.5M", 0.02 as "0.02".
std::string tick_text(double value);

}  // namespace kaustik::app
