#pragma once
// Kernels K(d) of the density estimate on a disc of radius r, each normalised to one over the disc, in 1/m^2.

#include <cstdint>

#include "core/math/vec.h"

namespace kaustik::photon {

enum class KernelType : uint8_t { kConstant, kCone, kEpanechnikov };

struct KernelSpec {
  KernelType type = KernelType::kConstant;
  float cone_k = 1.1f;  // k >= 1: the cone's weight reaches zero at k r
};

// K(d) = scale * (1 - slope * s) with s = 0 (constant), d (cone) or d^2 (Epanechnikov), for d <= r:
//   constant      1 / (pi r^2)
//   cone          (1 - d/(k r)) / ((1 - 2/(3k)) pi r^2)     Jensen 2001, section 7.2.1 (cone filter)
//   Epanechnikov  2 (1 - d^2/r^2) / (pi r^2)                Silverman 1986, section 4.2.1
struct KernelTerms {
  float scale = 0;  // 1/m^2
  float slope = 0;  // 1/m or 1/m^2
};

// radius in metres. A radius that is not positive and finite gives a kernel of zero: a disc without area
// holds no density.
inline KernelTerms kernel_terms(const KernelSpec& kernel, float radius) {
  if (!(radius > 0) || !std::isfinite(radius)) return {};
  const float area = kPi * radius * radius;
  switch (kernel.type) {
    case KernelType::kCone: {
      const float k = std::max(kernel.cone_k, 1.0f);
      return {1 / ((1 - 2 / (3 * k)) * area), 1 / (k * radius)};
    }
    case KernelType::kEpanechnikov:
      return {2 / area, 1 / (radius * radius)};
    case KernelType::kConstant:
      break;
  }
  return {1 / area, 0};
}

// K(d) from the squared distance in m^2, which must not exceed the squared radius.
inline float kernel_value(KernelType type, const KernelTerms& terms, float distance_squared) {
  switch (type) {
    case KernelType::kCone:
      return terms.scale * (1 - terms.slope * std::sqrt(distance_squared));
    case KernelType::kEpanechnikov:
      return terms.scale * (1 - terms.slope * distance_squared);
    case KernelType::kConstant:
      break;
  }
  return terms.scale;
}

}  // namespace kaustik::photon
