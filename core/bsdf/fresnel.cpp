#include "core/bsdf/fresnel.h"

namespace kaustik {

float fresnel_conductor(float cos_theta_i, float eta, float k) {
  const float cos_i = std::min(std::abs(cos_theta_i), 1.0f);
  const float cos2 = cos_i * cos_i;
  const float sin2 = (1 - cos_i) * (1 + cos_i);
  // (a + i b)^2 = (eta + i k)^2 - sin^2: the refracted cosine times the index.
  const float re = eta * eta - k * k - sin2;
  const float im = 2 * eta * k;
  const float modulus = std::sqrt(re * re + im * im);
  const float a = std::sqrt(std::max(0.0f, 0.5f * (modulus + re)));
  const float two_a_cos = 2 * a * cos_i;
  const float s_sum = modulus + cos2;
  if (!(s_sum + two_a_cos > 0)) return 1;
  const float perpendicular = (s_sum - two_a_cos) / (s_sum + two_a_cos);
  const float p_sum = cos2 * modulus + sin2 * sin2;
  const float p_cross = two_a_cos * sin2;
  if (!(p_sum + p_cross > 0)) return perpendicular;
  const float parallel = perpendicular * (p_sum - p_cross) / (p_sum + p_cross);
  return 0.5f * (perpendicular + parallel);
}

}  // namespace kaustik
