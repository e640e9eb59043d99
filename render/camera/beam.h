#pragma once
// A part of a ray in a medium.

#include "core/math/ray.h"
#include "core/medium/medium.h"
#include "core/spectrum/wavelength.h"

namespace kaustik::render {

// From the ray's start to what it meets.
struct Beam {
  Ray ray;             // unit direction
  float distance = 0;  // metres, may be infinite
  MediumIndex medium = kVacuum;
  float wavelength = kNoWavelength;  // of the light along the ray, if it has only one
};

}  // namespace kaustik::render
