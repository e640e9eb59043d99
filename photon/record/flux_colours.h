#pragma once
// The colours of flux in records. In scenes with dispersion records hold XYZ, in which spectral colours have
// no negative components, as RGB has; so RGB9E5, which has no signs, holds them, and sums over photons have
// the right mean. Scenes without dispersion keep RGB.

#include <array>
#include <cstdint>
#include <string_view>

#include "core/math/vec.h"
#include "core/spectrum/colour_space.h"

namespace kaustik::photon {

enum class FluxColours : uint8_t { kRgb, kXyz };
inline constexpr std::array<std::string_view, 2> kFluxColoursNames = {"rgb", "xyz"};

// Sum is a vector of three floats or doubles: flux, or sums that are linear in it.
template <class Sum>
Sum rgb_of_flux(const Sum& flux, FluxColours colours) {
  return colours == FluxColours::kRgb ? flux : Sum(white_xyz_to_ours() * glm::dvec3(flux));
}
inline Vector3 xyz_of_flux(const Rgb& flux) {
  return glm::max(Vector3(ours_to_white_xyz() * glm::dvec3(flux)), 0.0f);
}

}  // namespace kaustik::photon
