#pragma once
// Participating media: what fills the space between surfaces.

#include <cstdint>

#include "core/math/vec.h"

namespace kaustik {

// A medium that is the same everywhere.
struct Medium {
  Rgb sigma_a{0};  // absorption coefficient, 1/m, not negative
  Rgb sigma_s{0};  // scattering coefficient, 1/m, not negative
  // Mean cosine of the angle by which light is deflected, for the phase function of Henyey and Greenstein; at
  // most kLargestG away from zero.
  float g = 0;

  Rgb sigma_t() const { return sigma_a + sigma_s; }  // extinction coefficient, 1/m
  bool scatters() const { return !is_black(sigma_s); }
};

// Index into Scene::media. Photons on their way keep it in eight bits (photon/trace/lanes/walk_state.h).
using MediumIndex = uint8_t;
inline constexpr MediumIndex kVacuum = 0;
inline constexpr size_t kMostMedia = 255;  // the vacuum not counted

// The media on the two sides of a surface. `outside` is where its geometric normal points.
struct MediumInterface {
  MediumIndex inside = kVacuum, outside = kVacuum;

  // As in pbrt, a surface with the same medium on both sides lies in whatever medium a ray has come through.
  bool is_transition() const { return inside != outside; }
};

// exp(-sigma * distance) of each channel; the distance may be infinite.
inline Rgb exponential(const Rgb& sigma, float distance) {
  const auto left = [&](float s) { return s > 0 ? std::exp(-s * distance) : 1.0f; };
  return {left(sigma.x), left(sigma.y), left(sigma.z)};
}

// The share of light that is neither absorbed nor scattered along `distance` metres, which may be infinite
// (Beer and Lambert; Pharr 2023, section 11.2).
inline Rgb transmittance(const Medium& medium, float distance) {
  return exponential(medium.sigma_t(), distance);
}

}  // namespace kaustik
