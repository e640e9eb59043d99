#pragma once
// What covers a surface: one BSDF everywhere, or a recipe that makes it at each point.

#include <concepts>
#include <memory>
#include <optional>

#include "core/bsdf/bsdf.h"
#include "core/scene/material_inputs.h"
#include "core/scene/mixed_material.h"

namespace kaustik {

// How the BSDF of a point is made from a material's parameters there.
using BsdfMaker = Bsdf (*)(const MaterialInputs&);

// What differs from point to point.
struct TexturedMaterial {
  BsdfMaker make = nullptr;
  std::vector<MaterialInput> inputs;
  uint32_t displacement = kNoIndex;  // float texture of a bump map
  uint32_t normal_map = kNoIndex;    // image

  // Whether the BSDF itself does, not only its normal.
  bool makes_bsdf() const;
};

// A value; copies of a textured one share its recipe.
class Material {
 public:
  // The same everywhere. Implicit: constant materials are BSDFs.
  template <class B>
  requires std::constructible_from<Bsdf, const B&> Material(const B& bsdf)  // NOLINT
      : bsdf_(bsdf), anisotropic_(is_anisotropic(bsdf_)) {}
  // textures: those that its inputs name.
  Material(TexturedMaterial textured, const TextureSet& textures);
  // typical: of one of the two.
  Material(const MixedMaterial& mixed, const Bsdf& typical) : bsdf_(typical), mixed_(mixed) {}

  bool constant() const { return !textured_ && !mixed_; }
  // Constant, and no part of the surface needs to be known where it is met.
  bool plain() const { return constant() && !anisotropic_; }
  // Of a constant material; of others that of one point, for summaries.
  const Bsdf& typical() const { return bsdf_; }
  // Null for all that are not textured.
  const TexturedMaterial* textured() const { return textured_.get(); }
  // Null for all that are no mixtures.
  const MixedMaterial* mixed() const { return mixed_ ? &*mixed_ : nullptr; }
  // The parts that its BSDFs can have.
  Lobes lobes() const {
    if (varies_) return {true, true, false};
    return mixed_ ? mixed_->lobes : kaustik::lobes(bsdf_);
  }

 private:
  Bsdf bsdf_;
  std::shared_ptr<const TexturedMaterial> textured_;
  std::optional<MixedMaterial> mixed_;
  bool varies_ = false;       // between specular and not
  bool anisotropic_ = false;  // of a constant one
};

}  // namespace kaustik
