#pragma once
// Colours between given ones, for pictures in false colours.

#include <algorithm>
#include <array>

#include "core/math/vec.h"

namespace kaustik::render {

// The colour at t, clamped to [0, 1], of stops at equal distances; linear between them. At least two stops.
template <size_t N>
Rgb colour_on_ramp(const std::array<std::array<float, 3>, N>& stops, float t) {
  static_assert(N >= 2);
  const float s = std::clamp(t, 0.0f, 1.0f) * (N - 1);
  const size_t i = std::min(size_t(s), N - 2);
  const float f = s - float(i);
  Rgb out;
  for (size_t c = 0; c < 3; ++c) out[int(c)] = (1 - f) * stops[i][c] + f * stops[i + 1][c];
  return out;
}

}  // namespace kaustik::render
