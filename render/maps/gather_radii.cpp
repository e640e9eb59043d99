// Progressive reduction of the gather radius.

#include "render/maps/gather_radii.h"

namespace kaustik::render {

double RadiusShrink::squared(uint64_t pass, float alpha) {
  if (alpha == 1) return 1;
  if (pass < pass_ || alpha != alpha_) *this = {};
  alpha_ = alpha;
  for (; pass_ < pass; ++pass_) {
    const double i = static_cast<double>(pass_ + 1);
    squared_ *= (i + double(alpha)) / (i + 1);
  }
  return squared_;
}

}  // namespace kaustik::render
