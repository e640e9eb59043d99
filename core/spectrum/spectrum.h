#pragma once
// Spectra sampled at every nanometre, and their colours. Wavelengths are in nanometres. Rendering itself is
// done in RGB: spectra of a scene file are converted to linear Rec. 709 when it is read. Like pbrt-v4,
// integrals are sums over whole nanometres (Pharr 2023, section 4.6).

#include <array>
#include <functional>
#include <span>

#include "core/math/vec.h"

namespace kaustik {

inline constexpr int kFirstNanometre = 360, kLastNanometre = 830;

// Values at 360, 361, ..., 830 nm.
struct Spectrum {
  std::array<double, kLastNanometre - kFirstNanometre + 1> values{};

  static Spectrum from(const std::function<double(double)>& value_at);
  // The value at a wavelength, interpolated linearly between whole nanometres; the range's ends are repeated
  // beyond it.
  double at(double nanometres) const;
};

// Interpolates linearly between samples; zero outside them, as in pbrt. wavelengths: increasing, as many as
// values.
Spectrum sampled_spectrum(std::span<const double> wavelengths, std::span<const double> values);
// Planck's law for a temperature in kelvin > 0, scaled so that its maximum over all wavelengths is 1.
Spectrum blackbody(double kelvin);
// CIE daylight of a nominal temperature, such as 6500 for D65 (CIE 15:2004). Nominal temperatures refer to
// the radiation constant of 1931, which is 14380 / 14388 of today's. Below 4000 K, where daylight is not
// defined, the result is a blackbody. kelvin: <= 25000.
Spectrum daylight(double kelvin);
// CIE standard illuminant A, by its formula.
Spectrum illuminant_a();

// Sum over whole nanometres of the spectrum times x, y and z of the 1931 2-degree observer.
glm::dvec3 tristimulus(const Spectrum& s);

// Colour of a light in linear Rec. 709 (white: D65): its chromaticity at luminance 1, since pbrt scales the
// spectra of lights like this. Components are negative outside the gamut; NaN for a spectrum without
// luminance.
glm::dvec3 emitted_colour(const Spectrum& s);
// Colour of a reflectance or any other coefficient in linear Rec. 709, as seen under D65. A constant c gives
// (c, c, c); components are negative outside the gamut.
glm::dvec3 reflected_colour(const Spectrum& s);

// Metal in RGB: eta, and k chosen such that the reflectance at normal incidence is the colour that the
// spectral reflectance has under D65 (as far as k >= 0 allows).
struct MetalColour {
  glm::dvec3 eta{1}, k{0};
};
MetalColour metal_colour(const Spectrum& eta, const Spectrum& k);

}  // namespace kaustik
