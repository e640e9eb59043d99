// The rows of materials: parameters, and how each is made from them.

#include "core/scene/schema.h"

#include "core/scene/parameter_spec.h"

namespace kaustik {
namespace {

using namespace spec;

// What pbrt gives to every material and we leave out.
std::vector<ParameterSpec> material(std::vector<ParameterSpec> own) {
  own.push_back(ignored("displacement", {ParameterType::kTexture, ParameterType::kFloat}, "bump map", 0));
  own.push_back(ignored("normalmap", {ParameterType::kString}, "normal map"));
  return own;
}

// Rough reflection is another picture, so anything but zero is refused.
std::vector<ParameterSpec> smooth_material(std::vector<ParameterSpec> own) {
  for (const std::string_view name : {"roughness", "uroughness", "vroughness"}) {
    own.push_back(not_rendered(name, {ParameterType::kFloat, ParameterType::kTexture},
                               "only smooth surfaces are rendered: must be 0", 0));
  }
  own.push_back(ignored("remaproughness", {ParameterType::kBool}, "no effect on a smooth surface"));
  return material(std::move(own));
}

ParameterSpec metal_index(std::string_view name, std::string_view doc) {
  ParameterSpec p = without_default(rgb(name, 0, "", kNotNegative, doc), "copper");
  p.types.push_back(ParameterType::kFloat);
  return p;
}

// pbrt's metal of a given colour: eta = 1 and k so that the reflectance at normal incidence is r (pharr
// 2023, 9.4).
Conductor conductor_of_reflectance(const Rgb& reflectance) {
  const Rgb r = glm::clamp(reflectance, Rgb(0), Rgb(0.9999f));
  return {Rgb(1), 2.0f * glm::sqrt(r) / glm::sqrt(Rgb(1) - r)};
}

Bsdf make_conductor(const MaterialInputs& p) {
  if (p.has("reflectance")) return conductor_of_reflectance(p.rgb("reflectance"));
  // Copper's measured index at the wavelengths of the three primaries (Johnson and Christy 1972).
  Conductor copper{Rgb(0.200438f, 0.924033f, 1.102212f), Rgb(3.912949f, 2.452848f, 2.142188f)};
  if (p.has("eta")) copper.eta = p.rgb("eta");
  if (p.has("k")) copper.k = p.rgb("k");
  return copper;
}

std::vector<MaterialRow> make_material_rows() {
  const ParameterSpec reflectance =
      rgb("reflectance", 0.5, "", kUnit, "share of the light that is reflected");
  return {
      {{"diffuse", "Ideal diffuse reflection, both sides.", material({reflectance})},
       [](const MaterialInputs& p) -> Bsdf { return Lambertian{p.rgb("reflectance")}; }},
      {{"orennayar", "Rough diffuse reflection (Oren and Nayar 1994), both sides. Not in pbrt.",
        material({reflectance, number("sigma", 0, "degrees", {0, 90},
                                      "standard deviation of the facets' slope angle; 0: as diffuse")})},
       [](const MaterialInputs& p) -> Bsdf {
         return OrenNayar::from_sigma_degrees(p.rgb("reflectance"), static_cast<float>(p.number("sigma")));
       }},
      {{"dielectric", "Smooth glass or water: Fresnel reflection and refraction.",
        smooth_material({number("eta", 1.5, "", kPositive, "index of refraction, inside over outside")})},
       [](const MaterialInputs& p) -> Bsdf { return Dielectric{static_cast<float>(p.number("eta"))}; }},
      {{"conductor", "Smooth metal: give `reflectance`, or `eta` and `k`.",
        smooth_material(
            {without_default(rgb("reflectance", 0, "", kUnit, "reflectance at normal incidence"), "none"),
             metal_index("eta", "real part of the index of refraction"),
             metal_index("k", "imaginary part")})},
       make_conductor},
      {{"mirror", "Ideal mirror of constant reflectance, both sides. Not in pbrt.",
        material({rgb("reflectance", 1, "", kUnit, "share of the light that is reflected")})},
       [](const MaterialInputs& p) -> Bsdf { return Mirror{p.rgb("reflectance")}; }},
      {{"interface", "No surface at all: its shapes are left out.", {}}, nullptr},
  };
}

}  // namespace

const std::vector<MaterialRow>& material_rows() {
  static const std::vector<MaterialRow> rows = make_material_rows();
  return rows;
}

}  // namespace kaustik
