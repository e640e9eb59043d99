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
// Of pbrt, without numbers here: brass, and the sensitivities of cameras.
bool is_missing_spectrum(std::string_view name);

}  // namespace kaustik
