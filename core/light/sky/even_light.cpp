// Sampling of directions for light of uniform radiance.

#include "core/light/sky/even_light.h"

#include "core/math/frame.h"
#include "core/sampling/warp.h"

namespace kaustik {

Vector3 sample_even_light(const LightReceiver& x, const Point2& u) {
  if (!x.two_sided) return Frame::from_z(x.n).to_world(sample_cosine_hemisphere(u));
  if (u.x < 0.5f) return sample_uniform_sphere({2 * u.x, u.y});
  const bool behind = u.x < 0.75f;
  return Frame::from_z(behind ? -x.n : x.n)
      .to_world(sample_cosine_hemisphere({4 * u.x - (behind ? 2.0f : 3.0f), u.y}));
}

float even_light_pdf(const LightReceiver& x, const Vector3& wi) {
  const float cosine = glm::dot(x.n, wi);
  if (!x.two_sided) return cosine_hemisphere_pdf(cosine);
  return 0.5f * kUniformSpherePdf + 0.25f * cosine_hemisphere_pdf(std::abs(cosine));
}

}  // namespace kaustik
