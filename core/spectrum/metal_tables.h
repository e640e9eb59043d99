#pragma once
// Measured complex refractive indices.

#include <array>
#include <optional>
#include <string_view>

#include "core/spectrum/spectrum.h"

namespace kaustik {

struct MetalIndex {
  std::string_view name;  // for example "Au"
  Spectrum eta, k;
};
// The tables for Ag, Al, Au, Cu, MgO and TiO2.
const std::array<MetalIndex, 6>& metals();

}  // namespace kaustik
