#pragma once
// Indices of refraction as functions of the wavelength. None of these functions checks its arguments:
// valid_index() tells whether the result is an index of refraction.

#include <array>
#include <span>
#include <string_view>

#include "core/spectrum/spectrum.h"

namespace kaustik {

// The wavelength at which indices of refraction are quoted, in nm: the d line of helium.
inline constexpr double kHeliumLine = 587.56;

// Sellmeier's equation, n^2 = 1 + sum B_i l^2 / (l^2 - C_i) with l in micrometres.
// coefficients: B1 B2 B3 C1 C2 C3, the latter in square micrometres.
using SellmeierCoefficients = std::array<double, 6>;
Spectrum sellmeier_index(const SellmeierCoefficients& coefficients);
// Cauchy's equation, n = A + B / l^2 + C / l^4 + ... with l in micrometres.
Spectrum cauchy_index(std::span<const double> coefficients);
// Cauchy's equation with two terms, for an index at the d line and an Abbe number
// V = (n_d - 1) / (n_F - n_C), where F and C are lines of hydrogen, 486.13 nm and 656.28 nm.
Spectrum abbe_index(double eta, double abbe);
// Interpolates linearly between samples; the first and the last one are repeated beyond them. pairs:
// wavelength in nm, increasing, and index.
Spectrum sampled_index(std::span<const double> pairs);

// Whether all values are finite and between 0.01 and 100.
bool valid_index(const Spectrum& index);
// Whether the index differs between wavelengths by more than rounding.
bool varies(const Spectrum& index);

struct Glass {
  std::string_view name;  // pbrt's, such as "glass-BK7"
  SellmeierCoefficients coefficients;
};
// The glasses that pbrt knows by name, from Schott's data sheets.
std::span<const Glass> glasses();
// Null for other names.
const SellmeierCoefficients* glass_coefficients(std::string_view name);

}  // namespace kaustik
