#pragma once
// Measured media by name.

#include <string_view>
#include <vector>

#include "core/math/vec.h"

namespace kaustik {

// Coefficients in 1/mm. sigma_s is the reduced scattering coefficient, (1 - g) times the true one: it stands
// for isotropic scattering.
struct PresetMedium {
  std::string_view name;
  Rgb sigma_s, sigma_a;
};

// The measurements of Jensen, Marschner, Levoy and Hanrahan (2001), "A Practical Model for Subsurface Light
// Transport", and of Narasimhan et al. (2006), "Acquiring Scattering Properties of Participating Media by
// Dilution", under the names that pbrt gives them.
const std::vector<PresetMedium>& preset_media();

}  // namespace kaustik
