#pragma once
// Transmittance of a rough dielectric boundary, for materials that have a layer below it.

#include <algorithm>
#include <cmath>

#include "core/bsdf/microfacet/ggx.h"

namespace kaustik {

// The range of refractive indices in the table; others are clamped.
inline constexpr float kLeastCoatEta = 1, kLargestCoatEta = 4;

// Share of light from direction w (outside, |cos| = cos_theta) that a boundary with GGX facets transmits in
// one scattering event: refracted by a facet and not blocked by others. alpha: the same in both directions,
// in [0, 1]. A smooth boundary gives 1 - F. Interpolated in a table that is made at the first call (in some
// ten milliseconds), with an error below 0.01. Thread-safe.
float rough_transmittance(float cos_theta, float alpha, float eta);

// rough_transmittance() of one boundary, for many directions.
class RoughTransmittance {
 public:
  RoughTransmittance() = default;
  RoughTransmittance(float alpha, float eta);

  float operator()(float cos_theta) const {
    const float at = cos_theta > 0 ? std::sqrt(std::min(cos_theta, 1.0f)) * (kNodes - 1) : 0;
    const int i = std::min(int(at), kNodes - 2);
    return through_[i] + (at - float(i)) * (through_[i + 1] - through_[i]);
  }

  static constexpr int kNodes = 16;

 private:
  float through_[kNodes] = {};  // evenly spaced in the root of the cosine
};

// Share of uniform light from inside that a boundary with GGX facets reflects.
float rough_inner_reflectance(float alpha, float eta);

}  // namespace kaustik
