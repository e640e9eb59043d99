// Schema rows of pbrt's materials that are approximated by others: subsurface scattering, measured BSDFs,
// hair, and coated metal. A warning says what is left out of each.

#include <array>

#include "core/bsdf/coated_diffuse.h"
#include "core/bsdf/lambertian.h"
#include "core/scene/schema/material_spec.h"

namespace kaustik::spec {
namespace {

// Measured diffuse reflectances (Jensen et al. 2001, "A Practical Model for Subsurface Light Transport",
// figure 5), with pbrt's names.
struct Measured {
  std::string_view name;
  Rgb reflectance;
};
const std::array<Measured, 12>& measured_media() {
  static const std::array<Measured, 12> media = {{{"Apple", {0.85f, 0.84f, 0.53f}},
                                                  {"Chicken1", {0.31f, 0.15f, 0.10f}},
                                                  {"Chicken2", {0.32f, 0.16f, 0.10f}},
                                                  {"Cream", {0.98f, 0.90f, 0.73f}},
                                                  {"Ketchup", {0.16f, 0.01f, 0.00f}},
                                                  {"Marble", {0.83f, 0.79f, 0.75f}},
                                                  {"Potato", {0.77f, 0.62f, 0.21f}},
                                                  {"Skimmilk", {0.81f, 0.81f, 0.69f}},
                                                  {"Skin1", {0.44f, 0.22f, 0.13f}},
                                                  {"Skin2", {0.63f, 0.44f, 0.34f}},
                                                  {"Spectralon", {1.00f, 1.00f, 1.00f}},
                                                  {"Wholemilk", {0.91f, 0.88f, 0.76f}}}};
  return media;
}

// Diffuse reflectance of a half space for the light that has entered it, by the dipole approximation (Jensen
// et al. 2001, section 3.2). inside: reflectance of its surface for uniform light from inside.
float dipole_reflectance(float sigma_a, float reduced_sigma_s, float inside) {
  const float sigma_t = sigma_a + reduced_sigma_s;
  if (!(sigma_t > 0)) return 0;
  const float albedo = reduced_sigma_s / sigma_t;
  const float A = (1 + inside) / (1 - inside), root = std::sqrt(3 * (1 - albedo));
  return 0.5f * albedo * (1 + std::exp(-4.0f / 3 * A * root)) * std::exp(-root);
}

Rgb diffuse_reflectance(const MaterialInputs& p, float inside) {
  if (p.has("reflectance")) return p.rgb("reflectance");
  if (p.has("name")) {
    for (const Measured& m : measured_media()) {
      if (m.name == p.text("name")) return m.reflectance;
    }
    return Rgb(0.5f);
  }
  const Rgb sigma_a = p.rgb("sigma_a");
  const Rgb reduced = p.rgb("sigma_s") * (1 - static_cast<float>(p.number("g")));
  Rgb out;
  for (int c = 0; c < 3; ++c) out[c] = dipole_reflectance(sigma_a[c], reduced[c], inside);
  return out;
}

// The base under the coat is chosen such that it emits what the medium would: (1 - Ri) rho / (1 - rho Ri) of
// the light that enters.
Bsdf make_subsurface(const MaterialInputs& p) {
  const auto eta = static_cast<float>(p.number("eta"));
  const auto inside = static_cast<float>(fresnel_diffuse(1 / double(eta)));
  const Rgb Rd = glm::min(diffuse_reflectance(p, inside), Rgb(1));
  return CoatedDiffuse::from_reflectance(Rd / ((1 - inside) + inside * Rd), eta, facets_of(p));
}

// Inside the coat, the metal's index is relative to the coat.
Bsdf make_coated_conductor(const MaterialInputs& p) {
  Conductor metal = metal_of(p, "conductor.");
  const auto coat = static_cast<float>(p.number("interface.eta"));
  metal.eta /= coat;
  metal.k /= coat;
  return metal;
}

ParameterSpec spectrum(std::string_view name, const glm::dvec3& value, std::string_view doc) {
  return of_type(ParameterType::kRgb, name, {value.x, value.y, value.z}, "1/mm", kNotNegative, doc);
}

MaterialRow subsurface_row() {
  const Range coat{double(kLeastCoatEta), double(kLargestCoatEta)};
  TypeSpec spec{
      "subsurface", "A scattering medium under a smooth or rough surface.",
      rough_material(
          {without_default(rgb("reflectance", 0, "", kUnit,
                               "share of the light entering the medium that leaves it again"),
                           "from `name`, else from `sigma_a` and `sigma_s`"),
           text("name", "none",
                "a medium of Jensen et al. 2001 whose diffuse reflectance is used: Apple, Chicken1, "
                "Chicken2, Cream, Ketchup, Marble, Potato, Skimmilk, Skin1, Skin2, Spectralon, Wholemilk; "
                "other names give 0.5"),
           spectrum("sigma_a", {0.0011, 0.0024, 0.014}, "absorption coefficient"),
           spectrum("sigma_s", {2.55, 3.21, 3.77}, "scattering coefficient"),
           number("g", 0, "", {-1, 1}, "mean cosine of the scattering angle"),
           number("eta", 1.33, "", coat, "index of refraction"),
           ignored("mfp", {ParameterType::kRgb}, "light leaves where it entered"),
           ignored("scale", {ParameterType::kFloat}, "light leaves where it entered", 1)})};
  spec.approximated = "as \"coateddiffuse\" of the same reflectance: light leaves where it entered";
  return {std::move(spec), make_subsurface};
}

MaterialRow coated_conductor_row() {
  std::vector<ParameterSpec> own = {
      without_default(rgb("reflectance", 0, "", kUnit, "reflectance of the bare metal at normal incidence"),
                      "none"),
      metal_index("conductor.eta", "real part of the metal's index of refraction"),
      metal_index("conductor.k", "imaginary part of the metal's index of refraction"),
      number("conductor.roughness", 0, "", kNotNegative, "roughness of the GGX microfacets; 0: smooth"),
      number("interface.eta", 1.5, "", kPositive, "index of refraction of the coat")};
  for (const std::string_view name : {"conductor.uroughness", "conductor.vroughness"})
    own.push_back(without_default(
        number(name, 0, "", kNotNegative, "roughness along u (or v) of the surface"), "conductor.roughness"));
  own.push_back(
      flag("remaproughness", true,
           "true: the alpha of GGX is the square root of the roughness; false: it is the roughness"));
  for (const std::string_view name : {"interface.roughness", "interface.uroughness", "interface.vroughness"})
    own.push_back(
        ignored(name, {ParameterType::kFloat, ParameterType::kTexture}, "the coat reflects nothing"));
  for (ParameterSpec& p : medium_of_coat()) own.push_back(std::move(p));
  TypeSpec spec{"coatedconductor", "Metal under a coat of glass or varnish.", material(std::move(own))};
  spec.approximated =
      "as metal surrounded by the coat's index of refraction: the coat itself reflects nothing";
  return {std::move(spec), make_coated_conductor};
}

// The colour of hair whose absorption is that of its two pigments (d'Eon et al. 2011) or given, as pbrt
// inverts the albedo of a head of hair (Chiang et al. 2016, equation 9).
Rgb hair_colour(const MaterialInputs& p) {
  if (p.has("reflectance")) return p.rgb("reflectance");
  Rgb sigma_a(0.419f, 0.697f, 1.37f);
  if (p.has("sigma_a")) {
    sigma_a = p.rgb("sigma_a");
  } else {
    const bool pigments = p.has("eumelanin") || p.has("pheomelanin");
    const auto eumelanin = static_cast<float>(pigments ? p.number("eumelanin") : 1.3);
    const auto pheomelanin = static_cast<float>(pigments ? p.number("pheomelanin") : 0);
    sigma_a = eumelanin * sigma_a + pheomelanin * Rgb(0.187f, 0.4f, 1.05f);
  }
  const auto b = static_cast<float>(p.number("beta_n")), b2 = b * b;
  const float d =
      5.969f - 0.215f * b + 2.532f * b2 - 10.73f * b2 * b + 5.574f * b2 * b2 + 0.245f * b2 * b2 * b;
  return glm::exp(-d * glm::sqrt(sigma_a));
}

MaterialRow hair_row() {
  std::vector<ParameterSpec> own = {
      without_default(rgb("reflectance", 0, "", kUnit, "colour of a head of hair"), "from the absorption"),
      without_default(
          of_type(ParameterType::kRgb, "sigma_a", {0, 0, 0}, "1/radius", kNotNegative, "absorption"),
          "from the pigments"),
      number("eumelanin", 0, "", kNotNegative, "concentration of the brown pigment; 1.3 if none is given"),
      number("pheomelanin", 0, "", kNotNegative, "concentration of the red pigment"),
      number("beta_n", 0.3, "", kUnit, "azimuthal roughness; here it affects only the colour")};
  for (const std::string_view name : {"beta_m", "eta", "alpha"})
    own.push_back(ignored(name, {ParameterType::kFloat, ParameterType::kTexture}, "hair is diffuse here"));
  TypeSpec spec{"hair", "Fibres of hair or fur.", material(std::move(own))};
  spec.approximated = "as \"diffuse\" in the colour of a head of such hair";
  return {std::move(spec), [](const MaterialInputs& p) -> Bsdf { return Lambertian{hair_colour(p)}; }};
}

MaterialRow measured_row() {
  TypeSpec spec{"measured", "A measured BSDF.",
                material({text("filename", "none", "file of the measurements; it is not read")})};
  spec.approximated = "as \"diffuse\" with reflectance 0.5: the file is not read";
  return {std::move(spec), [](const MaterialInputs&) -> Bsdf { return Lambertian{Rgb(0.5f)}; }};
}

}  // namespace

std::vector<MaterialRow> approximated_material_rows() {
  return {subsurface_row(), coated_conductor_row(), hair_row(), measured_row()};
}

}  // namespace kaustik::spec
