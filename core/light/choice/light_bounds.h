#pragma once
#include "core/light/light.h"
#include "core/math/bounds.h"

namespace kaustik {

// What is known of a set of lights (Conty Estevez and Kulla 2018; Pharr et al. 2023, section 12.6.3): a box
// that holds them, a cone that holds the normals of what emits, and how far about a normal it emits.
struct LightBounds {
  Bounds3 box;
  Vector3 w{0, 0, 1};  // the cone's axis
  float phi = 0;       // sum of peak intensities (luminance, W/sr)
  float cos_o = -1;    // of the cone's half-angle
  float cos_e = 0;     // of the angle about a normal beyond which nothing is emitted
  bool two_sided = false;

  // In proportion to what the lights may give, W/m^2, up to a common factor: an estimate by the box's centre,
  // with angles as small as box and cone allow. Zero only where no light of the set gives anything.
  float importance(const LightReceiver& x) const;
};

// Nothing for lights without a place (distant, infinite) and those that emit nothing.
std::optional<LightBounds> light_bounds(const Light& light);
LightBounds united(const LightBounds& a, const LightBounds& b);

}  // namespace kaustik
