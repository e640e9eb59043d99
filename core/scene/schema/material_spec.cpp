// Parameter entries that rows of materials share, and how facets and metals are made from them.

#include "core/scene/schema/material_spec.h"

#include "core/spectrum/named_spectra.h"

namespace kaustik::spec {
namespace {

// pbrt's metal of a given colour: eta = 1, and k such that the reflectance at normal incidence is r (Pharr
// 2023, section 9.4).
Rgb k_of_reflectance(const Rgb& reflectance) {
  const Rgb r = glm::clamp(reflectance, Rgb(0), Rgb(0.9999f));
  return 2.0f * glm::sqrt(r) / glm::sqrt(Rgb(1) - r);
}

}  // namespace

std::vector<ParameterSpec> material(std::vector<ParameterSpec> own) {
  for (ParameterSpec& p : own) {
    const ParameterType type = p.types.front();
    const bool value = type == ParameterType::kFloat || type == ParameterType::kRgb;
    if (value && p.state == ParameterState::kUsed) p = textured(std::move(p));
  }
  own.push_back(without_default(textured(number("displacement", 0, "m", kAnyNumber,
                                                "bump map: height above the surface, along its normal")),
                                "none"));
  own.push_back(text("normalmap", "none", "image of normals in the frame of u, v and the shading normal"));
  return own;
}

std::vector<ParameterSpec> rough_material(std::vector<ParameterSpec> own) {
  own.push_back(number("roughness", 0, "", kNotNegative, "roughness of the GGX microfacets; 0: smooth"));
  for (const std::string_view name : {"uroughness", "vroughness"})
    own.push_back(without_default(
        number(name, 0, "", kNotNegative, "roughness along u (or v) of the surface"), "roughness"));
  own.push_back(
      flag("remaproughness", true,
           "true: the alpha of GGX is the square root of the roughness; false: it is the roughness"));
  return material(std::move(own));
}

std::vector<ParameterSpec> medium_of_coat() {
  constexpr ParameterType kNumber = ParameterType::kFloat;
  return {ignored("albedo", {ParameterType::kRgb, kNumber, ParameterType::kTexture},
                  "the coat holds no medium", 0),
          ignored("g", {kNumber, ParameterType::kTexture}, "the coat holds no medium", 0),
          ignored("thickness", {kNumber, ParameterType::kTexture}, "no effect without a medium", 0.01),
          ignored("maxdepth", {ParameterType::kInteger}, "all inner reflections are included", 10),
          ignored("nsamples", {ParameterType::kInteger}, "no random walk is made", 1)};
}

ParameterSpec metal_index(std::string_view name, std::string_view doc) {
  ParameterSpec p = without_default(rgb(name, 0, "", kNotNegative, doc), "copper");
  p.types.push_back(ParameterType::kFloat);
  return p;
}

Ggx facets_of(const MaterialInputs& p, std::string_view prefix) {
  const std::string both = std::string(prefix) + "roughness";
  const auto along = [&](std::string_view name) {
    const std::string own = std::string(prefix) + std::string(name);
    return static_cast<float>(p.number(p.has(own) ? own : both));
  };
  return Ggx::from_roughness(along("uroughness"), along("vroughness"), p.flag("remaproughness"));
}

Conductor metal_of(const MaterialInputs& p, std::string_view prefix) {
  const Ggx facets = facets_of(p, prefix);
  if (p.has("reflectance")) return {Rgb(1), k_of_reflectance(p.rgb("reflectance")), facets};
  static const MetalColour kCopper =
      metal_colour(*named_spectrum("metal-Cu-eta"), *named_spectrum("metal-Cu-k"));
  Conductor copper{Rgb(kCopper.eta), Rgb(kCopper.k), facets};
  const std::string eta = std::string(prefix) + "eta", k = std::string(prefix) + "k";
  if (p.has(eta)) copper.eta = p.rgb(eta);
  if (p.has(k)) copper.k = p.rgb(k);
  return copper;
}

}  // namespace kaustik::spec
