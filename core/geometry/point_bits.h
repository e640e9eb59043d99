#pragma once
// Keys by which points are found again at exactly the same position.

#include <array>
#include <bit>
#include <cstdint>

#include "core/math/vec.h"

namespace kaustik {

using PointBits = std::array<uint32_t, 3>;

// Points are equal exactly if their bits are: adding zero maps -0 to 0.
inline PointBits bits_of(const Point3& p) {
  return {std::bit_cast<uint32_t>(p.x + 0.0f), std::bit_cast<uint32_t>(p.y + 0.0f),
          std::bit_cast<uint32_t>(p.z + 0.0f)};
}

}  // namespace kaustik
