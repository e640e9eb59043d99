#pragma once
// Rays.

#include "core/math/vec.h"

namespace kaustik {

// Points o + t d for 0 < t < t_max. d need not be of unit length: t counts in lengths of d.
struct Ray {
  Point3 o{0};
  Vector3 d{0, 0, 1};
  float t_max = kInfinity;

  Point3 at(float t) const { return o + t * d; }
};

}  // namespace kaustik
