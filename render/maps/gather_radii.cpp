// Progressive reduction of the gather radius.

#include "render/maps/gather_radii.h"

#include <algorithm>

namespace kaustik::render {

void note_radii(const GatherRadii& radii, RenderStatistics* s) {
  s->direct_radius = radii.direct, s->caustic_radius = radii.caustic, s->indirect_radius = radii.indirect;
  s->medium_caustic_radius = radii.medium_caustic, s->medium_indirect_radius = radii.medium_indirect;
  s->radius = std::max({radii.direct, radii.caustic, radii.indirect});
}

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
