#include "core/bsdf/conductor.h"

#include "core/bsdf/fresnel.h"

namespace kaustik {

Rgb Conductor::reflectance(float cos_theta_i) const {
  return {fresnel_conductor(cos_theta_i, eta.x, k.x), fresnel_conductor(cos_theta_i, eta.y, k.y),
          fresnel_conductor(cos_theta_i, eta.z, k.z)};
}

std::optional<BsdfSample> Conductor::sample_f(const Vector3& wo, float /*uc*/, const Point2& /*u*/,
                                              TransportMode /*mode*/) const {
  if (wo.z == 0) return std::nullopt;
  return BsdfSample{{-wo.x, -wo.y, wo.z}, reflectance(wo.z), 1, true, false};
}

Rgb Conductor::albedo() const {
  // 2 int F(c) c dc by the midpoint rule; its weights sum to one.
  constexpr int kPoints = 8;
  Rgb sum(0);
  for (int i = 0; i < kPoints; ++i) {
    const float c = (i + 0.5f) / kPoints;
    sum += reflectance(c) * (2 * c / kPoints);
  }
  return sum;
}

}  // namespace kaustik
