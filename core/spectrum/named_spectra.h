#pragma once
// Spectra that pbrt-v4 knows by name.

#include <optional>
#include <string_view>
#include <vector>

#include "core/spectrum/spectrum.h"

namespace kaustik {

// "stdillum-D65", "illum-acesD60", "metal-Au-eta", "glass-BK7", ... Nothing for other names.
std::optional<Spectrum> named_spectrum(std::string_view name);
// All that named_spectrum knows.
std::vector<std::string_view> spectrum_names();
// Of pbrt's spectra that have no numbers here, the name that comes nearest: copper for brass, none (empty)
// for the sensitivities of cameras. Nothing for other names.
std::optional<std::string_view> nearest_to_missing_spectrum(std::string_view name);

}  // namespace kaustik
