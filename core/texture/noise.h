#pragma once
// Noise for procedural textures.

#include "core/math/vec.h"

namespace kaustik {

// Gradient noise (Perlin 2002, "Improving Noise"): values from about -1 to 1, zero at whole coordinates,
// period 256. Zero where a coordinate is not finite.
float noise(const Point3& p);

// Noise at (x, y, 0.5).
float noise(float x, float y);

// Parameters of sums of noise over octaves, each 1.99 times as fine and `omega` times as strong as the
// previous one. Octaves finer than the footprint (dpdx, dpdy) are omitted (Pharr 2004, section 11.6).
struct Octaves {
  float omega = 0.5f;
  int count = 8;
};
// Sum of noise, "fractional Brownian motion".
float fbm(const Point3& p, const Vector3& dpdx, const Vector3& dpdy, const Octaves& octaves);
// Sum of the absolute value of noise; omitted octaves count with their mean, about 0.2.
float turbulence(const Point3& p, const Vector3& dpdx, const Vector3& dpdy, const Octaves& octaves);

}  // namespace kaustik
