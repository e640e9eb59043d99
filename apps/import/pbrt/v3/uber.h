#pragma once
// Converts pbrt-v3's material "uber", a sum of up to five lobes, to the nearest of ours.

#include <string>

#include "apps/import/pbrt/v3/extras.h"

namespace kaustik::pbrt {

// Uber adds up diffuse light (Kd), a glossy coat (Ks), a mirror (Kr) and refraction (Kt), the last three by
// the Fresnel equations, and lets through what `opacity` leaves. Kr and Kt are the tints of a "dielectric";
// Kd under Ks or Kr is a "coateddiffuse"; Kd beside Kt is a "mix" of both, whose parts go to extras->parts.
// Returns the description of the result for a warning.
std::string upgrade_uber(Directive& material, V3Extras* extras);

}  // namespace kaustik::pbrt
