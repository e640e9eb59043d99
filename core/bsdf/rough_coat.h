#pragma once
// How much light a rough dielectric boundary lets through, for what lies under it.

#include <algorithm>
#include <cmath>

#include "core/bsdf/ggx.h"

namespace kaustik {

// The indices of refraction that the table holds; others are clamped.
inline constexpr float kLeastCoatEta = 1, kLargestCoatEta = 4;

// Share of light from direction w (outside, |cos| = cos_theta) that comes through GGX facets of this
// roughness in one scattering event: refracted by a facet and not blocked by others. alpha: of both
// directions, in [0, 1]. Of a smooth boundary 1 - F. Interpolated in a table that is made at the first call
// (some ten milliseconds); off by less than 0.01. Thread-safe.
float rough_transmittance(float cos_theta, float alpha, float eta);

// The same of one boundary, for many directions.
class RoughTransmittance {
 public:
  RoughTransmittance() = default;
  RoughTransmittance(float alpha, float eta);

  float operator()(float cos_theta) const {
    const float at = std::sqrt(std::min(cos_theta, 1.0f)) * (kNodes - 1);
    const int i = std::min(int(at), kNodes - 2);
    return through_[i] + (at - float(i)) * (through_[i + 1] - through_[i]);
  }

  static constexpr int kNodes = 16;

 private:
  float through_[kNodes] = {};  // by the root of the cosine, evenly spaced
};

// Share of even light from inside that such a boundary throws back.
float rough_inner_reflectance(float alpha, float eta);

}  // namespace kaustik
