#pragma once
// What covers a surface: one BSDF everywhere, or a recipe that makes it at each point.

#include <concepts>
#include <memory>
#include <optional>

#include "core/bsdf/bsdf.h"
#include "core/geometry/interaction.h"
#include "core/scene/material_inputs.h"
#include "core/scene/mixed_material.h"

namespace kaustik {

// How the BSDF of a point is made from a material's parameters there.
using BsdfMaker = Bsdf (*)(const MaterialInputs&);

// Whose BSDF depends on the point.
struct TexturedMaterial {
  BsdfMaker make = nullptr;
  std::vector<MaterialInput> inputs;
};

// A value; copies of a textured one share its recipe.
class Material {
 public:
  template <class B>
  requires std::constructible_from<Bsdf, const B&> Material(const B& bsdf)
      : bsdf_(bsdf) {}  // NOLINT: constant materials are BSDFs
  explicit Material(TexturedMaterial textured)
      : bsdf_(textured.make(MaterialInputs(textured.inputs))),
        textured_(std::make_shared<const TexturedMaterial>(std::move(textured))) {}
  // typical: of one of the two.
  Material(const MixedMaterial& mixed, const Bsdf& typical) : bsdf_(typical), mixed_(mixed) {}

  // The same everywhere.
  bool constant() const { return !textured_ && !mixed_; }
  // Of a constant material; of a textured one that of its typical point, for tables and summaries.
  const Bsdf& typical() const { return bsdf_; }
  // Null for constant ones.
  const TexturedMaterial* textured() const { return textured_.get(); }
  // Null for all that are no mixtures.
  const MixedMaterial* mixed() const { return mixed_ ? &*mixed_ : nullptr; }
  // The parts that its BSDFs can have; of a textured one those of its typical point.
  Lobes lobes() const { return mixed_ ? mixed_->lobes : kaustik::lobes(bsdf_); }

 private:
  Bsdf bsdf_;
  std::shared_ptr<const TexturedMaterial> textured_;
  std::optional<MixedMaterial> mixed_;
};

// The BSDF at a point of a surface that is seen, or lit by a photon, from wo (unit, world): a constant
// material's own, without a copy, or one made for the point and kept here.
class BsdfAt {
 public:
  BsdfAt(const std::vector<Material>& materials, const SurfaceInteraction& si, const Vector3& wo) {
    const Material& material = materials[si.material];
    if (material.constant()) {
      bsdf_ = &material.typical();
    } else {
      make(materials, si, wo);
    }
  }
  BsdfAt(const BsdfAt&) = delete;
  BsdfAt& operator=(const BsdfAt&) = delete;

  const Bsdf& operator*() const { return *bsdf_; }

 private:
  void make(const std::vector<Material>& materials, const SurfaceInteraction& si, const Vector3& wo);

  std::optional<Bsdf> made_;
  const Bsdf* bsdf_ = nullptr;
};

}  // namespace kaustik
