#pragma once
// The BSDF at a surface point.

#include "core/scene/scene.h"
#include "core/spectrum/wavelength.h"

namespace kaustik {

// The area over which a texture's value is averaged at a surface point: the steps on the surface from one
// pixel to the next, in world space. Zero means the point alone, looked up at the finest level.
struct Footprint {
  Vector3 dpdx{0}, dpdy{0};
};

// The arguments of a texture lookup at a surface point.
TexturePoint texture_point(const Scene& scene, const SurfaceInteraction& si, const Footprint& footprint = {});

// The BSDF at a surface point that is seen, or lit by a photon, from wo (unit, world). Refers to the BSDF of
// a constant material without a copy; otherwise makes one for the point and keeps it. wavelength: for
// dispersion; kNoWavelength stands for that of the d line.
class BsdfAt {
 public:
  // Replaces si.ns by the normal of the material's bump or normal map, if it has one, and sets si.tangent if
  // the BSDF is anisotropic.
  BsdfAt(const Scene& scene, SurfaceInteraction& si, const Vector3& wo, const Footprint& footprint = {},
         float wavelength = kNoWavelength) {
    const Material& material = scene.materials[si.material];
    bsdf_ = &material.typical();
    if (!material.constant_and_isotropic()) make(scene, wo, footprint, wavelength, si);
  }
  BsdfAt(const BsdfAt&) = delete;
  BsdfAt& operator=(const BsdfAt&) = delete;

  const Bsdf& operator*() const { return *bsdf_; }

 private:
  void make(const Scene& scene, const Vector3& wo, const Footprint& footprint, float wavelength,
            SurfaceInteraction& si);
  void disperse(const Spectrum& eta, float wavelength);

  std::optional<Bsdf> made_;
  const Bsdf* bsdf_;
};

}  // namespace kaustik
