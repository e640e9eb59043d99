// Fresnel reflectance for uniform light, and of conductors.

#include "core/bsdf/microfacet/fresnel.h"

namespace kaustik {

double fresnel_diffuse(double eta) {
  // From the denser side, by reciprocity: the transmittances for uniform light differ by a factor of eta^2.
  if (eta < 1) return 1 - (1 - fresnel_diffuse(1 / eta)) * eta * eta;
  // Near eta = 1, where the terms would cancel, the reflectance is about (eta - 1) / 3.
  if (eta < 1.0001) return (eta - 1) / 3;
  const double n = eta, n2 = n * n, n4 = n2 * n2, plus = n2 + 1, minus = n4 - 1;
  return 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
         n2 * (n2 - 1) * (n2 - 1) / (plus * plus * plus) * std::log((n - 1) / (n + 1)) -
         2 * n * n2 * (n2 + 2 * n - 1) / (plus * minus) +
         8 * n4 * (n4 + 1) / (plus * minus * minus) * std::log(n);
}

float fresnel_conductor(float cos_theta_i, float eta, float k) {
  const float cos_i = std::min(std::abs(cos_theta_i), 1.0f);
  const float cos2 = cos_i * cos_i;
  const float sin2 = (1 - cos_i) * (1 + cos_i);
  // (a + i b)^2 = (eta + i k)^2 - sin^2 is the square of the refracted cosine times the index.
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
  // With an index that matches the surroundings, rounding could make the result negative.
  return std::max(0.0f, 0.5f * (perpendicular + parallel));
}

}  // namespace kaustik
