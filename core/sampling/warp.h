#pragma once
// Maps from the unit square to the sampled domains, with their densities (Pharr et al. 2023, appendix A).
// Sine and cosine are polynomials rather than the C library's functions: they are faster, and give the same
// bits on every machine.

#include "core/math/vec.h"

namespace kaustik {

// (cos, sin) of an angle in [-pi/4, pi/4] by Taylor polynomials; the first omitted term is below 2^-28.
inline Point2 cos_sin_octant(float x) {
  const float x2 = x * x;
  const float s = x + x * x2 * (-1.0f / 6 + x2 * (1.0f / 120 + x2 * (-1.0f / 5040 + x2 * (1.0f / 362880))));
  const float c =
      1 + x2 * (-0.5f + x2 * (1.0f / 24 + x2 * (-1.0f / 720 + x2 * (1.0f / 40320 - x2 * (1.0f / 3628800)))));
  return {c, s};
}

// (cos, sin) of 2 pi turns, for turns in [0, 1]. Branchless: the quadrant of a random number cannot be
// predicted.
inline Point2 cos_sin_turns(float turns) {
  const int quadrant = static_cast<int>(4 * turns + 0.5f);
  const Point2 cs = cos_sin_octant((4 * turns - static_cast<float>(quadrant)) * (0.5f * kPi));
  const bool swap = quadrant & 1;
  const float c = swap ? cs.y : cs.x;
  const float s = swap ? cs.x : cs.y;
  return {(quadrant + 1) & 2 ? -c : c, quadrant & 2 ? -s : s};
}

// Radius and unit direction of Shirley and Chiu's (1997) concentric map of the square to the disk.
struct PolarSample {
  float r;
  Point2 direction;
};
inline PolarSample sample_disk_polar(const Point2& u) {
  const float a = 2 * u.x - 1;
  const float b = 2 * u.y - 1;
  const bool along_x = std::abs(a) > std::abs(b);
  const float longer = along_x ? a : b;
  const float shorter = along_x ? b : a;
  const Point2 cs = cos_sin_octant(0.25f * kPi * (longer != 0 ? shorter / longer : 0.0f));
  const float c = longer < 0 ? -cs.x : cs.x;
  const float s = longer < 0 ? -cs.y : cs.y;
  return {std::abs(longer), along_x ? Point2(c, s) : Point2(s, c)};
}

// Point in the unit disk, pdf 1/pi.
inline Point2 sample_uniform_disk_concentric(const Point2& u) {
  const PolarSample s = sample_disk_polar(u);
  return s.r * s.direction;
}

// Direction about +z, pdf = z/pi (Malley's method).
inline Vector3 sample_cosine_hemisphere(const Point2& u) {
  const PolarSample s = sample_disk_polar(u);
  const Point2 xy = s.r * s.direction;
  return {xy.x, xy.y, std::sqrt((1 - s.r) * (1 + s.r))};
}
inline float cosine_hemisphere_pdf(float cos_theta) {
  return cos_theta > 0 ? cos_theta * kInvPi : 0;
}

// Uniform direction within the angle acos(cos_theta_max) of +z. `one_minus_cos` = 1 - cos_theta_max, in [0,
// 2], keeps precision for thin cones.
inline Vector3 sample_uniform_cone(const Point2& u, float one_minus_cos) {
  const float h = u.x * one_minus_cos;  // 1 - cos theta
  const float sin_theta = std::sqrt(std::max(0.0f, h * (2 - h)));
  const Point2 xy = sin_theta * cos_sin_turns(u.y);
  return {xy.x, xy.y, 1 - h};
}
inline float uniform_cone_pdf(float one_minus_cos) {
  return 1 / (2 * kPi * one_minus_cos);
}

// Uniform direction, pdf 1/(4 pi).
inline Vector3 sample_uniform_sphere(const Point2& u) {
  return sample_uniform_cone(u, 2);
}
inline constexpr float kUniformSpherePdf = 0.25f * kInvPi;

// Barycentrics (b1, b2) of a uniform point of a triangle, pdf 1/area (Heitz 2019, low-distortion map).
inline Point2 sample_uniform_triangle(const Point2& u) {
  const float half = 0.5f * std::min(u.x, u.y);
  return {u.x - half, u.y - half};
}

}  // namespace kaustik
