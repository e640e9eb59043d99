// Schema rows of materials: their parameters, and how each BSDF is made from them.

#include "core/scene/schema/schema.h"

#include "core/bsdf/microfacet/rough_coat.h"
#include "core/scene/schema/material_spec.h"

namespace kaustik {
namespace {

using namespace spec;

// Adds the parameters of a coat.
std::vector<ParameterSpec> coat(std::vector<ParameterSpec> own) {
  for (ParameterSpec& p : medium_of_coat()) own.push_back(std::move(p));
  return rough_material(std::move(own));
}

// Adds the colours of a dielectric's lobes.
std::vector<ParameterSpec> with_tints(std::vector<ParameterSpec> own) {
  own.push_back(rgb("reflectance", 1, "", kUnit, "factor on the light that is reflected. Not in pbrt-v4"));
  own.push_back(
      rgb("transmittance", 1, "", kUnit, "factor on the light that is transmitted. Not in pbrt-v4"));
  return own;
}

// Adds what tells how the index of refraction depends on the wavelength. At most one of these is given.
std::vector<ParameterSpec> with_dispersion(std::vector<ParameterSpec> own) {
  const auto add = [&](std::string_view name, size_t least, size_t most, std::string_view doc) {
    own.push_back(list(ParameterType::kFloat, name, least, "none", "", doc));
    own.back().max_items = most;
  };
  own.push_back(without_default(
      number("abbe", 0, "", kPositive,
             "Abbe number: how little the index, which `eta` gives at 587.56 nm, depends on the wavelength; "
             "55 for crown glass, 25 for heavy flint glass. Not in pbrt-v4"),
      "none"));
  add("cauchy", 1, 8,
      "index A + B/l^2 + C/l^4 + ..., where l is the wavelength in micrometres. Not in pbrt-v4");
  add("sellmeier", 6, 6,
      "B1 B2 B3 C1 C2 C3 of Sellmeier's formula for the index; the last three in square micrometres. Not in "
      "pbrt-v4");
  add("indices", 4, 2000,
      "pairs of wavelength in nm and index. Not in pbrt-v4, where `eta` is a spectrum instead: that is "
      "accepted too");
  return own;
}

LobeTints tints_of(const MaterialInputs& p) {
  return {p.rgb("reflectance"), p.rgb("transmittance")};
}

ParameterSpec two_names(std::string_view name, std::string_view doc) {
  ParameterSpec p = text(name, "none", doc);
  p.min_items = p.max_items = 2;
  return p;
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
  return Dielectric{eta, eta == 1 ? Ggx{} : facets_of(p), tints_of(p)};
}

Bsdf make_thin_dielectric(const MaterialInputs& p) {
  return ThinDielectric{static_cast<float>(p.number("eta")), tints_of(p)};
}

std::vector<MaterialRow> make_material_rows() {
  const ParameterSpec reflectance =
      rgb("reflectance", 0.5, "", kUnit, "share of the light that is reflected");
  std::vector<MaterialRow> rows = {
      {{"diffuse", "Ideal diffuse reflection, both sides.", material({reflectance})},
       [](const MaterialInputs& p) -> Bsdf { return Lambertian{p.rgb("reflectance")}; }},
      {{"orennayar", "Rough diffuse reflection (Oren and Nayar 1994), both sides. Not in pbrt.",
        material({reflectance, number("sigma", 0, "degrees", {0, 90},
                                      "standard deviation of the facets' slope angle; 0: as diffuse")})},
       [](const MaterialInputs& p) -> Bsdf {
         return OrenNayar::from_sigma_degrees(p.rgb("reflectance"), static_cast<float>(p.number("sigma")));
       }},
      {{"dielectric", "Glass or water, smooth or rough: Fresnel reflection and refraction.",
        with_dispersion(rough_material(
            with_tints({number("eta", 1.5, "", kPositive, "index of refraction, inside over outside")})))},
       make_dielectric},
      {{"conductor", "Metal, smooth or rough: give `reflectance`, or `eta` and `k`.",
        rough_material(
            {without_default(rgb("reflectance", 0, "", kUnit, "reflectance at normal incidence"), "none"),
             metal_index("eta", "real part of the index of refraction"),
             metal_index("k", "imaginary part of the index of refraction")})},
       [](const MaterialInputs& p) -> Bsdf { return metal_of(p); }},
      {{"mirror", "Ideal mirror of constant reflectance, both sides. Not in pbrt.",
        material({rgb("reflectance", 1, "", kUnit, "share of the light that is reflected")})},
       [](const MaterialInputs& p) -> Bsdf { return Mirror{p.rgb("reflectance")}; }},
      {{"thindielectric",
        "A pane of glass without thickness: straight transmission, and all reflections inside it.",
        material(with_tints(
            {number("eta", 1.5, "", kPositive, "index of refraction of the pane over its surroundings")}))},
       make_thin_dielectric},
      {{"diffusetransmission",
        "A sheet that scatters light evenly to both sides. Shares that add up to more than one are scaled to "
        "one; pbrt lets such a sheet create light.",
        material({rgb("reflectance", 0.25, "", kUnit, "share of the light that is reflected"),
                  rgb("transmittance", 0.25, "", kUnit, "share of the light that is transmitted"),
                  number("scale", 1, "", kNotNegative, "factor on both shares, which are limited to one")})},
       make_diffuse_transmission},
      {{"coateddiffuse",
        "Diffuse under a coat of glass or varnish, both sides. All reflections between coat and base are "
        "summed in closed form; pbrt's random walk stops after `maxdepth` and is slightly darker.",
        coat({reflectance,
              number("eta", 1.5, "", {kLeastCoatEta, kLargestCoatEta}, "index of refraction of the coat")})},
       [](const MaterialInputs& p) -> Bsdf {
         return CoatedDiffuse::from_reflectance(p.rgb("reflectance"), static_cast<float>(p.number("eta")),
                                                facets_of(p));
       }},
      {{"mix",
        "At each hit one of two materials; the second with probability `amount`. Both are named materials "
        "defined before it, and may be mixtures themselves, 256 deep at most.",
        {two_names("materials", "names of the first and the second material"),
         textured(number("amount", 0.5, "", kUnit, "probability of the second material"))}},
       nullptr},
      {{"interface", "No surface for light: its shapes only separate media.", {}}, nullptr},
  };
  for (MaterialRow& row : approximated_material_rows()) rows.push_back(std::move(row));
  return rows;
}

}  // namespace

const std::vector<MaterialRow>& material_rows() {
  static const std::vector<MaterialRow> rows = make_material_rows();
  return rows;
}

}  // namespace kaustik
