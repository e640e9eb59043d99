#pragma once
// What covers a surface: one BSDF everywhere, or a recipe that makes it at each point.

#include <concepts>
#include <memory>
#include <optional>

#include "core/bsdf/bsdf.h"
#include "core/geometry/interaction.h"
#include "core/scene/material_inputs.h"

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

  // The same everywhere.
  bool constant() const { return !textured_; }
  // Of a constant material; of a textured one that of its typical point, for tables and summaries.
  const Bsdf& typical() const { return bsdf_; }
  // Null for constant ones.
  const TexturedMaterial* textured() const { return textured_.get(); }

 private:
  Bsdf bsdf_;
  std::shared_ptr<const TexturedMaterial> textured_;
};

// The BSDF at a point of a surface: a constant material's own, without a copy, or one made for the point and
// kept here.
class BsdfAt {
 public:
  BsdfAt(const std::vector<Material>& materials, const SurfaceInteraction& si) {
    const Material& material = materials[si.material];
    if (material.constant()) {
      bsdf_ = &material.typical();
    } else {
      make(*material.textured(), si);
    }
  }
  BsdfAt(const BsdfAt&) = delete;
  BsdfAt& operator=(const BsdfAt&) = delete;

  const Bsdf& operator*() const { return *bsdf_; }

 private:
  void make(const TexturedMaterial& material, const SurfaceInteraction& si);

  std::optional<Bsdf> made_;
  const Bsdf* bsdf_ = nullptr;
};

}  // namespace kaustik
