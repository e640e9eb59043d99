#pragma once
#include "core/scene/scene.h"

namespace kaustik {

// What a texture's value at a point stands for: the steps on the surface from one pixel to the next, in world
// space. Zero: the point alone, looked up at the finest level.
struct Footprint {
  Vector3 dpdx{0}, dpdy{0};
};

// For textures, at a point of a surface.
TexturePoint texture_point(const Scene& scene, const SurfaceInteraction& si, const Footprint& footprint = {});

// The BSDF at a point of a surface that is seen, or lit by a photon, from wo (unit, world): a constant
// material's own, without a copy, or one made for the point and kept here.
class BsdfAt {
 public:
  // si.ns becomes that of the bump or normal map, where the material has one; si.tangent is set where the
  // BSDF is anisotropic.
  BsdfAt(const Scene& scene, SurfaceInteraction& si, const Vector3& wo, const Footprint& footprint = {}) {
    const Material& material = scene.materials[si.material];
    bsdf_ = &material.typical();
    if (!material.plain()) make(scene, wo, footprint, si);
  }
  BsdfAt(const BsdfAt&) = delete;
  BsdfAt& operator=(const BsdfAt&) = delete;

  const Bsdf& operator*() const { return *bsdf_; }

 private:
  void make(const Scene& scene, const Vector3& wo, const Footprint& footprint, SurfaceInteraction& si);

  std::optional<Bsdf> made_;
  const Bsdf* bsdf_;
};

}  // namespace kaustik
