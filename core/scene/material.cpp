// Constructs textured materials.

#include "core/scene/material.h"

#include <algorithm>

#include "core/spectrum/refractive_index.h"

namespace kaustik {

namespace {

bool is_textured(const MaterialInput& input) {
  return input.texture != kNoIndex;
}

Bsdf bsdf_of_one_point(const TexturedMaterial& material, const TextureSet& textures) {
  TexturePoint middle;
  middle.uv = {0.5f, 0.5f};
  return material.make(MaterialInputs(material.inputs, &textures, &middle));
}

}  // namespace

bool TexturedMaterial::makes_bsdf() const {
  return std::any_of(inputs.begin(), inputs.end(), is_textured);
}

Material::Material(TexturedMaterial textured, const TextureSet& textures)
    : bsdf_(bsdf_of_one_point(textured, textures)) {
  // Whether a surface is specular or diffuse depends on its roughness.
  const auto is_roughness = [](const MaterialInput& i) {
    return is_textured(i) && i.name.ends_with("roughness");
  };
  varies_ = std::any_of(textured.inputs.begin(), textured.inputs.end(), is_roughness);
  textured_ = std::make_shared<const TexturedMaterial>(std::move(textured));
}

void Material::disperse(std::shared_ptr<const Spectrum> eta) {
  std::get<Dielectric>(bsdf_).disperse(eta->at(kHeliumLine));
  dispersion_ = std::move(eta);
}

}  // namespace kaustik
