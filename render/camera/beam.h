#pragma once
// A part of a ray in a medium.

#include "core/math/ray.h"
#include "core/medium/medium.h"

namespace kaustik::render {

// From the ray's start to what it meets.
struct Beam {
  Ray ray;             // unit direction
  float distance = 0;  // metres, may be infinite
  MediumIndex medium = kVacuum;
};

}  // namespace kaustik::render
