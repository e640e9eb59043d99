#pragma once
// Fresnel equations for unpolarised light.

#include "core/math/vec.h"

namespace kaustik {

// Cosine of the refracted angle (Snell's law); -1 at total internal reflection. eta: transmitted over
// incident side; cos_theta_i >= 0.
inline float refracted_cosine(float cos_theta_i, float eta) {
  const float sin2_t = std::max(0.0f, (1 - cos_theta_i) * (1 + cos_theta_i)) / (eta * eta);
  return sin2_t < 1 ? std::sqrt(1 - sin2_t) : -1.0f;
}

// Reflectance if both cosines are known (Pharr et al. 2023, equation 9.6); cos_theta_t as returned by
// refracted_cosine.
inline float fresnel_from_cosines(float cos_theta_i, float cos_theta_t, float eta) {
  if (cos_theta_t < 0) return 1;
  const float parallel = (eta * cos_theta_i - cos_theta_t) / (eta * cos_theta_i + cos_theta_t);
  const float perpendicular = (cos_theta_i - eta * cos_theta_t) / (cos_theta_i + eta * cos_theta_t);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

// Unpolarised reflectance of a dielectric boundary. eta: transmitted over incident side for cos_theta_i > 0,
// and the inverse for cos_theta_i < 0. One at total internal reflection; zero if eta = 1, where there is no
// boundary.
inline float fresnel_dielectric(float cos_theta_i, float eta) {
  if (eta == 1) return 0;
  const float relative = cos_theta_i < 0 ? 1 / eta : eta;
  const float cos_i = std::min(std::abs(cos_theta_i), 1.0f);
  return fresnel_from_cosines(cos_i, refracted_cosine(cos_i, relative), relative);
}

// Reflectance of a dielectric boundary for uniform light, int fresnel_dielectric 2 cos dcos; eta > 0 as
// there. Closed form (Walsh 1926; in d'Eon 2021, "An Analytic BRDF for Materials with Spherical Lambertian
// Scatterers", appendix), with an error below 1e-6.
double fresnel_diffuse(double eta);

// Unpolarised reflectance of a conductor with complex index eta + i k (relative to the outside), in real
// arithmetic (Born and Wolf 1999, section 14.2). The sign of cos_theta_i does not matter.
float fresnel_conductor(float cos_theta_i, float eta, float k);

}  // namespace kaustik
