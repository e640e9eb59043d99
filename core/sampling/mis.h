#pragma once
// Weights for multiple importance sampling.

namespace kaustik {

// Power heuristic with beta = 2 (Veach 1997, section 9.2.4): the weight of a sample of density pdf, where
// `other` is the density of the other strategy. Computed from a ratio, so that squares of large densities do
// not overflow.
inline float power_heuristic(float pdf, float other) {
  if (!(pdf > 0)) return 0;
  const float ratio = other / pdf;
  return 1 / (1 + ratio * ratio);
}

}  // namespace kaustik
