#pragma once
// Light of one wavelength, for paths that dispersive glass has refracted. All other light is RGB.
//
// An RGB colour c stands for the spectrum  S(l) = c . rho(l)  times that of D65, the renderer's white. rho
// are three functions that are never negative, add up to one, and give back the colour: the light S(l)
// D65(l), as the CIE's observer sees it, is c (Mallett and Yuksel 2019, "Spectral Primary Decomposition for
// Rendering with sRGB Reflectance"). So the mean of at_wavelength(c, l) over sampled wavelengths l is exactly
// c.

#include "core/math/vec.h"

namespace kaustik {

// Wavelengths are in nm, from 359.5 to 830.5. Light that has not been dispersed has none.
inline constexpr float kNoWavelength = 0;

// The wavelength for a random number u in [0, 1). Where the eye sees more, wavelengths are denser.
float sample_wavelength(float u);

// The part of c's light that has this wavelength, divided by the density of the sample, in linear Rec. 709.
// Components may be negative, since pure spectral colours lie outside its gamut.
Rgb at_wavelength(const Rgb& c, float wavelength);

}  // namespace kaustik
