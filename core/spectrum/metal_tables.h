#pragma once
// Measured indices of refraction.

#include <array>
#include <optional>
#include <string_view>

#include "core/spectrum/spectrum.h"

namespace kaustik {

struct MetalIndex {
  std::string_view name;  // "Au"
  Spectrum eta, k;
};
// Ag, Al, Au, Cu, MgO, TiO2.
const std::array<MetalIndex, 6>& metals();

}  // namespace kaustik
