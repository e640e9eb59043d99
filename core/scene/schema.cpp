// The rows of materials: parameters, and how each is made from them.

#include "core/scene/schema.h"
#include "core/bsdf/rough_coat.h"

#include "core/scene/parameter_spec.h"

namespace kaustik {
namespace {

using namespace spec;

// What pbrt gives to every material, and textures for all that is a number or a colour.
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

// pbrt's ways to say how rough a surface is.
std::vector<ParameterSpec> rough_material(std::vector<ParameterSpec> own) {
  own.push_back(number("roughness", 0, "", kNotNegative, "of GGX microfacets; 0: smooth"));
  for (const std::string_view name : {"uroughness", "vroughness"})
    own.push_back(
        without_default(number(name, 0, "", kNotNegative, "along u (v) of the surface"), "roughness"));
  own.push_back(flag("remaproughness", true, "alpha of GGX is the root of roughness, else roughness itself"));
  return material(std::move(own));
}

// A coat without a medium in it.
std::vector<ParameterSpec> coat(std::vector<ParameterSpec> own) {
  constexpr ParameterType kNumber = ParameterType::kFloat;
  own.push_back(not_rendered("albedo", {ParameterType::kRgb, kNumber, ParameterType::kTexture},
                             "a coat's medium is not rendered: set it to 0, and let `reflectance` be what "
                             "base and medium reflect together",
                             0));
  own.push_back(ignored("g", {kNumber, ParameterType::kTexture}, "of a medium", 0));
  own.push_back(ignored("thickness", {kNumber, ParameterType::kTexture}, "no effect without a medium", 0.01));
  own.push_back(ignored("maxdepth", {ParameterType::kInteger}, "all inner reflections are there", 10));
  own.push_back(ignored("nsamples", {ParameterType::kInteger}, "no random walk", 1));
  return rough_material(std::move(own));
}

ParameterSpec two_names(std::string_view name, std::string_view doc) {
  ParameterSpec p = text(name, "none", doc);
  p.min_items = p.max_items = 2;
  return p;
}

Ggx facets(const MaterialInputs& p) {
  const auto along = [&](std::string_view name) {
    return static_cast<float>(p.number(p.has(name) ? name : "roughness"));
  };
  return Ggx::from_roughness(along("uroughness"), along("vroughness"), p.flag("remaproughness"));
}

ParameterSpec metal_index(std::string_view name, std::string_view doc) {
  ParameterSpec p = without_default(rgb(name, 0, "", kNotNegative, doc), "copper");
  p.types.push_back(ParameterType::kFloat);
  return p;
}

// pbrt's metal of a given colour: eta = 1 and k so that the reflectance at normal incidence is r (pharr
// 2023, 9.4).
Rgb k_of_reflectance(const Rgb& reflectance) {
  const Rgb r = glm::clamp(reflectance, Rgb(0), Rgb(0.9999f));
  return 2.0f * glm::sqrt(r) / glm::sqrt(Rgb(1) - r);
}

Bsdf make_conductor(const MaterialInputs& p) {
  if (p.has("reflectance")) return Conductor{Rgb(1), k_of_reflectance(p.rgb("reflectance")), facets(p)};
  // Copper's measured index at the wavelengths of the three primaries (Johnson and Christy 1972).
  Conductor copper{Rgb(0.200438f, 0.924033f, 1.102212f), Rgb(3.912949f, 2.452848f, 2.142188f), facets(p)};
  if (p.has("eta")) copper.eta = p.rgb("eta");
  if (p.has("k")) copper.k = p.rgb("k");
  return copper;
}

Bsdf make_diffuse_transmission(const MaterialInputs& p) {
  const auto scale = static_cast<float>(p.number("scale"));
  DiffuseTransmission sheet{glm::min(scale * p.rgb("reflectance"), Rgb(1)),
                            glm::min(scale * p.rgb("transmittance"), Rgb(1))};
  const Rgb both = sheet.reflectance + sheet.transmittance, too_much = glm::max(both, Rgb(1));
  sheet.reflectance /= too_much;
  sheet.transmittance /= too_much;
  return sheet;
}

Bsdf make_dielectric(const MaterialInputs& p) {
  const auto eta = static_cast<float>(p.number("eta"));
  return Dielectric{eta, eta == 1 ? Ggx{} : facets(p)};
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
      {{"dielectric", "Glass or water, smooth or rough: Fresnel reflection and refraction.",
        rough_material({number("eta", 1.5, "", kPositive, "index of refraction, inside over outside")})},
       make_dielectric},
      {{"conductor", "Metal, smooth or rough: give `reflectance`, or `eta` and `k`.",
        rough_material(
            {without_default(rgb("reflectance", 0, "", kUnit, "reflectance at normal incidence"), "none"),
             metal_index("eta", "real part of the index of refraction"),
             metal_index("k", "imaginary part")})},
       make_conductor},
      {{"mirror", "Ideal mirror of constant reflectance, both sides. Not in pbrt.",
        material({rgb("reflectance", 1, "", kUnit, "share of the light that is reflected")})},
       [](const MaterialInputs& p) -> Bsdf { return Mirror{p.rgb("reflectance")}; }},
      {{"thindielectric",
        "A pane of glass without thickness: all reflections in it, and straight transmission.",
        material(
            {number("eta", 1.5, "", kPositive, "index of refraction of the pane over its surroundings")})},
       [](const MaterialInputs& p) -> Bsdf { return ThinDielectric{static_cast<float>(p.number("eta"))}; }},
      {{"diffusetransmission",
        "A sheet that scatters light evenly to both sides. Where both shares add up to more than one, they "
        "are "
        "scaled to one; pbrt lets such a sheet make light.",
        material({rgb("reflectance", 0.25, "", kUnit, "share of the light that is reflected"),
                  rgb("transmittance", 0.25, "", kUnit, "share that comes through"),
                  number("scale", 1, "", kNotNegative, "multiplies both shares, up to one each")})},
       make_diffuse_transmission},
      {{"coateddiffuse",
        "Diffuse under a coat of glass or varnish, both sides. All reflections between coat and base, in "
        "closed "
        "form; pbrt walks at random and stops after `maxdepth`, so that it is darker by a little.",
        coat({reflectance,
              number("eta", 1.5, "", {kLeastCoatEta, kLargestCoatEta}, "index of refraction of the coat")})},
       [](const MaterialInputs& p) -> Bsdf {
         return CoatedDiffuse::from_reflectance(p.rgb("reflectance"), static_cast<float>(p.number("eta")),
                                                facets(p));
       }},
      {{"mix",
        "At each hit one of two materials, the second as often as `amount` says. Both are named materials "
        "defined "
        "before it; mixtures may be mixed.",
        {two_names("materials", "names of the first and the second material"),
         textured(number("amount", 0.5, "", kUnit, "share of the second material"))}},
       nullptr},
      {{"interface", "No surface at all: its shapes are left out.", {}}, nullptr},
  };
}

}  // namespace

const std::vector<MaterialRow>& material_rows() {
  static const std::vector<MaterialRow> rows = make_material_rows();
  return rows;
}

}  // namespace kaustik
