#pragma once
// Sums that do not depend on the order of their terms: integer multiples of a power-of-two unit, in 128 bits.
// Each term is rounded once, to the unit, and the additions are exact, so any order and any split gives the
// same bits (the fixed-point idea of reproducible summation, Demmel and Nguyen 2015).

#include <cmath>
#include <cstdint>

namespace kaustik::render {

__extension__ typedef __int128 Int128;

class ExactSum {
 public:
  // Terms are clamped to 2^kTermBits units, so that 2^31 of them cannot overflow.
  static constexpr int kTermBits = 95;

  // Adds x, rounded to the nearest multiple of the unit (ties to even); per_unit is 1 / unit, a power of two.
  // Returns false if x was NaN, which adds nothing, or larger than 2^95 units in magnitude, which is clamped.
  bool add(double x, double per_unit) {
    constexpr double kMost = 0x1p95;
    const double units = x * per_unit;
    if (std::abs(units) <= kMost) {
      value_ += rounded(units);
      return true;
    }
    if (!std::isnan(units)) value_ += rounded(std::copysign(kMost, units));
    return false;
  }
  ExactSum& operator+=(const ExactSum& o) {
    value_ += o.value_;
    return *this;
  }
  // The sum as the nearest double, times the unit.
  double value(double unit) const { return static_cast<double>(value_) * unit; }

  friend bool operator==(const ExactSum& a, const ExactSum& b) { return a.value_ == b.value_; }

 private:
  // Rounds a value of at most 2^95 in magnitude. Converts two halves of a machine word each, since the
  // compiler's conversion to 128 bits is a slow call. The upper half is a multiple of 2^47, so the lower one
  // alone decides the rounding.
  static Int128 rounded(double units) {
    const auto high = static_cast<int64_t>(units * 0x1p-47);
    const double rest = units - static_cast<double>(high) * 0x1p47;  // exact
    return static_cast<Int128>(high) * (int64_t{1} << 47) + std::llrint(rest);
  }

  Int128 value_ = 0;
};

}  // namespace kaustik::render
