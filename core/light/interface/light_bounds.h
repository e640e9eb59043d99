#pragma once
// Bounds of sets of lights, from which their importance at a point is estimated.

#include "core/light/interface/light_types.h"
#include "core/math/bounds.h"

namespace kaustik {

// Bounds of a set of lights (Conty Estevez and Kulla 2018; Pharr et al. 2023, section 12.6.3): a box around
// the emitters, a cone around their normals, and the angle about a normal within which they emit.
struct LightBounds {
  Bounds3 box;
  Vector3 w{0, 0, 1};  // axis of the cone
  float phi = 0;       // sum of peak intensities (luminance, W/sr)
  float cos_o = -1;    // cosine of the cone's half-angle
  float cos_e = 0;     // cosine of the angle about a normal beyond which nothing is emitted
  bool two_sided = false;

  // Proportional to the irradiance (W/m^2) that the lights may cause at x, up to a common factor: an estimate
  // from the centre of the box, with angles as small as box and cone allow. Zero only if no light of the set
  // contributes.
  float importance(const LightReceiver& x) const;
};

// The bounds of a light at p of intensity I in all directions.
LightBounds bounds_of_point(const Point3& p, const Rgb& I);
LightBounds united(const LightBounds& a, const LightBounds& b);

}  // namespace kaustik
