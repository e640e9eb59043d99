#pragma once
#include "core/math/vec.h"

namespace kaustik {

// Perlin 2002, "Improving Noise": about -1 to 1, zero at whole coordinates; period 256. Zero where a
// coordinate is not finite.
float noise(const Point3& p);

// At (x, y, 0.5).
float noise(float x, float y);

// Sums of noise over octaves, each 1.99 times as fine and `omega` times as strong as the one before, up to
// those that the footprint (dpdx, dpdy) is too wide for (pharr 2004, section 11.6).
struct Octaves {
  float omega = 0.5f;
  int count = 8;
};
// Of noise itself, "fractional Brownian motion".
float fbm(const Point3& p, const Vector3& dpdx, const Vector3& dpdy, const Octaves& octaves);
// Of its absolute value; octaves that are left out count by their mean, about 0.2.
float turbulence(const Point3& p, const Vector3& dpdx, const Vector3& dpdy, const Octaves& octaves);

}  // namespace kaustik
