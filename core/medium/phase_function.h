#pragma once
// The phase function of Henyey and Greenstein (1941): the directions into which a medium scatters light.

#include "core/math/frame.h"
#include "core/sampling/warp.h"

namespace kaustik {

// Nearer to 1 the lobe is as thin as a ray.
inline constexpr float kLargestG = 0.999f;

// Value in 1/sr for light that is deflected by an angle of this cosine; its integral over the sphere is one,
// so that it is the density of sample_phase(), too. g: mean cosine (Pharr 2023, section 11.3.1).
inline float phase(float cos_deflection, float g) {
  // 1 + g^2 - 2 g cos, which is (1 - |g|)^2 and more, without cancellation.
  const float away = 1 - std::abs(g);
  const float s = away * away + 2 * std::abs(g) * (g < 0 ? 1 + cos_deflection : 1 - cos_deflection);
  return 0.25f * kInvPi * (1 - g * g) / (s * std::sqrt(s));
}

// The direction in which light goes on that arrives in direction d (both unit, in the direction of travel).
inline Vector3 sample_phase(const Vector3& d, float g, const Point2& u) {
  // The inverse of the distribution of 1 - cos of the deflection, for |g|, without a division by g.
  const float a = std::abs(g), divisor = 1 - a + 2 * a * u.x;
  const float one_minus_cos = (1 - a) * (1 - u.x) / divisor * ((1 - a * a) / divisor + 1 - a);
  const float sine = std::sqrt(std::max(one_minus_cos * (2 - one_minus_cos), 0.0f));
  const Point2 cs = cos_sin_turns(u.y);
  return Frame::from_z(g < 0 ? -d : d).to_world({sine * cs.x, sine * cs.y, 1 - one_minus_cos});
}

}  // namespace kaustik
