#pragma once
// The spectra that pbrt-v4 knows by name.

#include <optional>
#include <string_view>
#include <vector>

#include "core/spectrum/spectrum.h"

namespace kaustik {

// The spectrum called "stdillum-D65", "illum-acesD60", "metal-Au-eta", "glass-BK7" and so on; nothing for
// other names.
std::optional<Spectrum> named_spectrum(std::string_view name);
// All names that named_spectrum() knows.
std::vector<std::string_view> spectrum_names();
// For a named spectrum of pbrt that is not implemented, the name of the nearest one that is: copper for
// brass, and an empty name for camera sensitivities, which have none. Nothing for names that pbrt does not
// know.
std::optional<std::string_view> nearest_to_missing_spectrum(std::string_view name);

}  // namespace kaustik
