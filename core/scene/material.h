#pragma once
// Surface materials: one BSDF for all points, or a recipe that makes the BSDF of each point.

#include <concepts>
#include <memory>
#include <optional>

#include "core/bsdf/bsdf.h"
#include "core/scene/material_inputs.h"
#include "core/scene/mixed_material.h"
#include "core/spectrum/spectrum.h"

namespace kaustik {

// Makes the BSDF of a point from the values of a material's parameters there.
using BsdfMaker = Bsdf (*)(const MaterialInputs&);

// The recipe of a material that varies from point to point.
struct TexturedMaterial {
  BsdfMaker make = nullptr;
  std::vector<MaterialInput> inputs;
  uint32_t displacement = kNoIndex;  // float texture of the bump map
  uint32_t normal_map = kNoIndex;    // image of the normal map

  // Whether the BSDF itself varies, and not only the shading normal.
  bool makes_bsdf() const;
};

// A value type; copies of a textured material share its recipe.
class Material {
 public:
  // A material that is the same at every point. Implicit, so that a BSDF can be used as a constant material.
  template <class B>
  requires std::constructible_from<Bsdf, const B&> Material(const B& bsdf)  // NOLINT
      : bsdf_(bsdf), anisotropic_(is_anisotropic(bsdf_)) {}
  // `textures` are those that its inputs refer to.
  Material(TexturedMaterial textured, const TextureSet& textures);
  // `typical` is the BSDF of one of the two materials.
  Material(const MixedMaterial& mixed, const Bsdf& typical) : bsdf_(typical), mixed_(mixed) {}

  // Makes the index of refraction of a material of Dielectric BSDFs depend on the wavelength.
  void disperse(std::shared_ptr<const Spectrum> eta);

  // Whether the BSDF is the same at every point and for all light.
  bool constant() const { return !textured_ && !mixed_ && !dispersion_; }
  // Whether the material is constant and isotropic, so that its BSDF needs nothing but the shading frame.
  bool constant_and_isotropic() const { return constant() && !anisotropic_; }
  // The BSDF of a constant material; for other materials that of one point, to be used in summaries.
  const Bsdf& typical() const { return bsdf_; }
  // Null unless the material is textured.
  const TexturedMaterial* textured() const { return textured_.get(); }
  // Index of refraction by wavelength; null unless it depends on that.
  const Spectrum* dispersion() const { return dispersion_.get(); }
  // Whether the index of refraction depends on the wavelength, that of one of its materials if it is a
  // mixture.
  bool is_dispersive() const { return mixed_ ? mixed_->dispersive : dispersion_ != nullptr; }
  // Whether textures decide the BSDF, of one of its materials if it is a mixture.
  bool has_textured_bsdf() const { return mixed_ ? mixed_->textured : textured_ && textured_->makes_bsdf(); }
  // Null unless the material is a mixture.
  const MixedMaterial* mixed() const { return mixed_ ? &*mixed_ : nullptr; }
  // The kinds of lobes that its BSDFs can have.
  Lobes lobes() const {
    if (varies_) return {true, true, false};
    return mixed_ ? mixed_->lobes : kaustik::lobes(bsdf_);
  }

 private:
  Bsdf bsdf_;
  std::shared_ptr<const TexturedMaterial> textured_;
  std::optional<MixedMaterial> mixed_;
  std::shared_ptr<const Spectrum> dispersion_;
  bool varies_ = false;       // between specular and diffuse
  bool anisotropic_ = false;  // for constant materials
};

}  // namespace kaustik
