#include "apps/bench/log_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kaustik::app {

namespace {

constexpr double kRoom = 0.06;  // margin at each end, as a share of the axis's length
constexpr size_t kMostTicks = 8;

// All mantissas times 10^k within the range, for every `every_decade`-th k.
std::vector<double> decade_ticks(double low, double high, const std::vector<double>& mantissas,
                                 int every_decade) {
  std::vector<double> ticks;
  const int first = static_cast<int>(std::floor(std::log10(low)));
  for (int k = first - (first % every_decade + every_decade) % every_decade; std::pow(10, k) <= high;
       k += every_decade)
    for (const double m : mantissas) {
      // Dividing gives the double nearest to 0.02; multiplying by pow(10, -2) may not.
      const double tick = k >= 0 ? m * std::pow(10, k) : m / std::pow(10, -k);
      if (tick >= low && tick <= high) ticks.push_back(tick);
    }
  return ticks;
}

// The densest set with at most kMostTicks ticks. Neighbours in the first set are less than a factor of 1.34
// apart, so a range of a factor of two contains at least two ticks.
std::vector<double> round_ticks(double low, double high) {
  const std::vector<double> sets[] = {{1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8}, {1, 1.5, 2, 3, 5, 7}, {1, 2, 5}};
  for (const std::vector<double>& set : sets) {
    std::vector<double> ticks = decade_ticks(low, high, set, 1);
    if (ticks.size() <= kMostTicks) return ticks;
  }
  for (int every = 1;; ++every) {
    std::vector<double> ticks = decade_ticks(low, high, {1}, every);
    if (ticks.size() <= kMostTicks) return ticks;
  }
}

}  // namespace

LogAxis::LogAxis(double least, double most, double first_pixel, double last_pixel, std::vector<double> ticks)
    : first_pixel_(first_pixel), last_pixel_(last_pixel), ticks_(std::move(ticks)) {
  double low = std::log(least), high = std::log(most);
  const double missing = std::max(0.0, std::log(2) - (high - low));
  low -= missing / 2, high += missing / 2;
  const double room = kRoom * (high - low);
  low_ = std::exp(low - room), high_ = std::exp(high + room);
  if (ticks_.empty()) ticks_ = round_ticks(low_, high_);
  std::erase_if(ticks_, [this](double t) { return !(t >= low_ && t <= high_); });
  std::sort(ticks_.begin(), ticks_.end());
}

double LogAxis::pixel(double value) const {
  const double share = std::log(value / low_) / std::log(high_ / low_);
  return first_pixel_ + share * (last_pixel_ - first_pixel_);
}

std::string tick_text(double value) {
  constexpr std::pair<double, char> kSuffixes[] = {{1e12, 'T'}, {1e9, 'G'}, {1e6, 'M'}, {1e3, 'k'}};
  for (const auto& [unit, suffix] : kSuffixes)
    if (value >= unit) return fmt::format("{:.6g}{}", value / unit, suffix);
  return fmt::format("{:.6g}", value);
}

}  // namespace kaustik::app
