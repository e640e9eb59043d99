#pragma once
// Spectra as densely as the eye needs them, and the colours that they give. Wavelengths are in nanometres.
// The renderer itself knows no spectra: what a scene file says in them is reduced to linear Rec. 709 when it
// is read. pbrt-v4's sums are over the same whole nanometres (pharr 2023, 4.6).

#include <array>
#include <functional>
#include <span>

#include "core/math/vec.h"

namespace kaustik {

inline constexpr int kFirstNanometre = 360, kLastNanometre = 830;

// Values at 360, 361, ... 830 nm.
struct Spectrum {
  std::array<double, kLastNanometre - kFirstNanometre + 1> values{};

  static Spectrum from(const std::function<double(double)>& value_at);
  // At a wavelength within the range, linear between whole nanometres.
  double at(double nanometres) const;
};

// Straight lines between samples, zero outside them, as in pbrt. wavelengths: increasing, as many as values.
Spectrum sampled_spectrum(std::span<const double> wavelengths, std::span<const double> values);
// Planck's law for a temperature in kelvin > 0, scaled to a maximum of 1 (over all wavelengths).
Spectrum blackbody(double kelvin);
// CIE daylight of a nominal temperature, such as 6500 for D65 (CIE 15:2004; the nominal temperatures are
// those of the radiation constant of 1931, 14380 / 14388 of today's). Below 4000 K, where there is none: a
// blackbody. kelvin: <= 25000.
Spectrum daylight(double kelvin);
// CIE illuminant A, by its formula.
Spectrum illuminant_a();

// Integral of the spectrum times x, y and z of the 1931 2-degree observer, per nanometre.
glm::dvec3 tristimulus(const Spectrum& s);

// Colours in linear Rec. 709, whose white is D65. Those outside of its gamut have negative components.
// Of a light: its chromaticity at luminance 1, which is how pbrt scales the spectra of lights. NaN for one
// that nobody sees.
glm::dvec3 emitted_colour(const Spectrum& s);
// Of a share that is reflected, or any other coefficient: seen under D65. A constant c gives (c, c, c).
glm::dvec3 reflected_colour(const Spectrum& s);

// A metal of three channels: eta, and k such that the reflectance at normal incidence is the colour that the
// spectral one has under D65 (to within k >= 0).
struct MetalColour {
  glm::dvec3 eta{1}, k{0};
};
MetalColour metal_colour(const Spectrum& eta, const Spectrum& k);

}  // namespace kaustik
