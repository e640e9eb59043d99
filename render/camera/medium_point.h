#pragma once
// A point in a medium that scatters, with the same functions as a surface point
// (render/camera/shading_point.h).

#include "core/bsdf/bsdf_types.h"
#include "core/light/interface/light_types.h"
#include "core/medium/phase_function.h"
#include "core/scene/media.h"
#include "core/spectrum/wavelength.h"

namespace kaustik::render {

struct MediumPoint {
  Point3 p{0};
  Vector3 wo{0};  // unit, world, to the viewer (or to the previous vertex of the camera path)
  float g = 0;
  MediumIndex medium = kVacuum;
  float wavelength = kNoWavelength;  // of light that leaves towards wo, if it has only one

  // The point as LightSampler sees it.
  LightReceiver receiver() const { return {p, wo, true, true}; }
};

// The phase function in 1/sr. Not included: the share of the light that the medium scatters at all.
inline Rgb f_cos(const MediumPoint& x, const Vector3& wi, LobePart part = LobePart::kDiffuse) {
  return part == LobePart::kDiffuse ? Rgb(phase(-glm::dot(x.wo, wi), x.g)) : Rgb(0);
}

// Density of sample_phase() per solid angle.
inline float scatter_pdf(const MediumPoint& x, const Vector3& wi, LobePart /*part*/ = LobePart::kDiffuse) {
  return phase(-glm::dot(x.wo, wi), x.g);
}

inline Point3 position(const MediumPoint& x) {
  return x.p;
}
// Ray that leaves in direction w, which need not be of unit length.
inline Ray spawn(const MediumPoint& x, const Vector3& w, float t_max = kInfinity) {
  return {x.p, w, t_max};
}
inline MediumIndex medium_towards(const Scene& /*scene*/, const MediumPoint& x, const Vector3& /*w*/) {
  return x.medium;
}

}  // namespace kaustik::render
