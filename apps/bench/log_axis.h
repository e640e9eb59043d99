#pragma once
// A logarithmic axis: its range, its ticks and the positions of values on it.

#include <string>
#include <vector>

namespace kaustik::app {

class LogAxis {
 public:
  // Shows the range from `least` to `most` (both above zero) with a margin, and at least a factor of two. The
  // pixels are the positions of the two ends, in either order. If `ticks` is empty, the ticks are two to
  // eight round numbers.
  LogAxis(double least, double most, double first_pixel, double last_pixel, std::vector<double> ticks);

  double pixel(double value) const;
  const std::vector<double>& ticks() const { return ticks_; }  // those within the range, ascending

 private:
  double low_ = 1, high_ = 2;  // ends of the axis
  double first_pixel_ = 0, last_pixel_ = 1;
  std::vector<double> ticks_;
};

// Formats the label of a tick: 1500000 as "1.5M", 0.02 as "0.02".
std::string tick_text(double value);

}  // namespace kaustik::app
