#pragma once
// Participating media: what fills the space between surfaces.

#include <cstdint>

#include "core/math/vec.h"

namespace kaustik {

// A medium that is the same everywhere and only absorbs.
struct Medium {
  Rgb sigma_a{0};  // absorption coefficient, 1/m, not negative
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

// The share of light that is left after `distance` metres, which may be infinite (Beer and Lambert; Pharr
// 2023, section 11.2).
inline Rgb transmittance(const Medium& medium, float distance) {
  const auto left = [&](float sigma) { return sigma > 0 ? std::exp(-sigma * distance) : 1.0f; };
  return {left(medium.sigma_a.x), left(medium.sigma_a.y), left(medium.sigma_a.z)};
}

}  // namespace kaustik
