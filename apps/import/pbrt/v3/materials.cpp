#include "apps/import/pbrt/v3/materials.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "apps/import/pbrt/v3/material_edits.h"
#include "apps/import/pbrt/v3/uber.h"

namespace kaustik::pbrt {

using namespace v3;

namespace {

std::string coated(Directive& d, double diffuse) {
  make_coated(d, diffuse, 0.1);
  return "\"coateddiffuse\": the coat reflects by the Fresnel equations, and `Ks` is ignored";
}

std::string matte(Directive& d) {
  const bool rough = number(d, "sigma", 0) > 0;
  d.type = rough ? "orennayar" : "diffuse";
  rename(d, "Kd", "reflectance");
  set_default(d, "reflectance", 0.5);
  if (!rough) erase(d, {"sigma"});
  return rough ? "\"orennayar\"" : "\"diffuse\"";
}

std::string plastic(Directive& d) {
  return coated(d, 0.25);
}
std::string substrate(Directive& d) {
  return coated(d, 0.5);
}

std::string glass(Directive& d) {
  d.type = "dielectric";
  rename(d, "index", "eta");
  rename(d, "Kr", "reflectance");
  rename(d, "Kt", "transmittance");
  for (const std::string_view tint : {"reflectance", "transmittance"}) scale_colour(d, tint, 1);
  keep_width(d, 0, true);
  return "\"dielectric\" with `Kr` and `Kt` as its `reflectance` and `transmittance`";
}

std::string metal(Directive& d) {
  d.type = "conductor";
  keep_width(d, 0.01);
  return "\"conductor\"";
}

std::string mirror(Directive& d) {
  if (!d.find("Kr")) return "";  // kaustik has a material "mirror" of its own
  rename(d, "Kr", "reflectance");
  return "kaustik's \"mirror\" with `Kr` as its `reflectance`";
}

// v3's `reflect` and `transmit` multiply Kd. If Kd is a texture, both sides get half of it.
std::string translucent(Directive& d) {
  const Parameter* kd = d.find("Kd");
  const bool textured = kd && kd->numbers.empty();
  d.type = "diffusetransmission";
  set_default(d, "Kd", 0.25);
  Parameter reflectance = *d.find("Kd"), transmittance = reflectance;
  reflectance.name = "reflectance", transmittance.name = "transmittance";
  for (auto& [target, share] : {std::pair{&reflectance, "reflect"}, std::pair{&transmittance, "transmit"}}) {
    const Parameter* s = d.find(share);
    for (size_t i = 0; i < target->numbers.size() && target->type == ParameterType::kRgb; ++i)
      target->numbers[i] *= s && s->numbers.size() == 3 ? s->numbers[i % 3] : 0.5;
  }
  erase(d, {"Kd", "Ks", "reflect", "transmit", "roughness", "remaproughness"});
  d.parameters.push_back(std::move(reflectance));
  d.parameters.push_back(std::move(transmittance));
  if (textured) add(d, ParameterType::kFloat, "scale", {0.5});
  return "\"diffusetransmission\"; `Ks` is ignored";
}

// Light passes two boundaries of a body, so v3 tints each by the root of the colour.
void tint_by_root(Directive& d) {
  Parameter* colour = d.find("reflectance");
  colour->name = "transmittance";
  if (colour->type == ParameterType::kRgb)
    for (double& v : colour->numbers) v = std::sqrt(std::clamp(v, 0.0, 1.0));
}

std::string disney(Directive& d) {
  const bool clear = number(d, "spectrans", 0) > 0.5, metallic = number(d, "metallic", 0) > 0.5;
  rename(d, "color", "reflectance");
  set_default(d, "reflectance", 0.5);
  // disney's GGX width is roughness^2; v4 would take the root.
  const double roughness = number(d, "roughness", 0.5);
  const double alpha = std::max(0.001, roughness * roughness);
  erase(d, {"spectrans", "metallic", "anisotropic", "specular", "speculartint", "sheen", "sheentint",
            "clearcoat", "clearcoatgloss", "scatterdistance", "thin", "difftrans", "flatness", "roughness"});
  add(d, ParameterType::kFloat, "roughness", {alpha});
  add(d, ParameterType::kBool, "remaproughness", {0});
  d.type = clear ? "dielectric" : metallic ? "conductor" : "coateddiffuse";
  if (clear) tint_by_root(d);
  if (metallic && !clear) erase(d, {"eta"});
  return "\"dielectric\" if `spectrans` is above 0.5, else \"conductor\" if `metallic` is, else "
         "\"coateddiffuse\"; only `color`, `roughness` and `eta` are kept";
}

// "subsurface" exists in both versions; these parameters occur only in v3.
std::string subsurface(Directive& d) {
  const bool of_v3 =
      d.find("Kr") || d.find("Kt") || d.find("Kd") || d.find("index") || d.type != "subsurface";
  if (!of_v3) return "";
  d.type = "subsurface";
  rename(d, "Kd", "reflectance");
  rename(d, "index", "eta");
  erase(d, {"Kr", "Kt"});
  keep_width(d, 0, true);
  return "v4's \"subsurface\", without `Kr` and `Kt`";
}

std::string kd_subsurface(Directive& d) {
  set_default(d, "Kd", 0.5);
  return subsurface(d);
}

std::string fourier(Directive& d) {
  d.type = "measured";
  rename(d, "bsdffile", "filename");
  return "v4's \"measured\"";
}

// v3's `amount` is the share of the first material, v4's that of the second. Swapping the materials works for
// textured amounts too.
std::string mix(Directive& d) {
  const Parameter* first = d.find("namedmaterial1");
  const Parameter* second = d.find("namedmaterial2");
  if (!first || !second || first->strings.size() != 1 || second->strings.size() != 1) return "";
  Parameter materials = *second;
  materials.name = "materials";
  materials.strings.push_back(first->strings[0]);
  if (!first->value_places.empty()) materials.value_places.push_back(first->value_places[0]);
  Parameter* amount = d.find("amount");
  if (amount && amount->strings.empty() && !amount->numbers.empty()) {
    double mean = 0;
    for (const double v : amount->numbers) mean += v / double(amount->numbers.size());
    amount->type = ParameterType::kFloat;
    amount->numbers.assign(1, mean);
  }
  erase(d, {"namedmaterial1", "namedmaterial2"});
  d.parameters.push_back(std::move(materials));
  return "v4's \"mix\" with its materials swapped, since v4's `amount` is the share of the second";
}

std::string none(Directive& d) {
  d.type = "interface";
  d.parameters.clear();
  return "\"interface\"";
}

}  // namespace

std::string upgrade_v3_material(Directive& d, V3Extras* extras) {
  if (d.type == "uber") {
    rename(d, "bumpmap", "displacement");
    return upgrade_uber(d, extras);
  }
  using Upgrade = std::string (*)(Directive&);
  static const std::map<std::string_view, Upgrade> table = {{"", none},
                                                            {"disney", disney},
                                                            {"fourier", fourier},
                                                            {"glass", glass},
                                                            {"kdsubsurface", kd_subsurface},
                                                            {"matte", matte},
                                                            {"metal", metal},
                                                            {"mirror", mirror},
                                                            {"mix", mix},
                                                            {"none", none},
                                                            {"plastic", plastic},
                                                            {"subsurface", subsurface},
                                                            {"substrate", substrate},
                                                            {"translucent", translucent}};
  const auto found = table.find(d.type);
  if (found == table.end()) return "";
  const std::string change = found->second(d);
  if (change.empty()) return "";
  rename(d, "bumpmap", "displacement");
  return change;
}

}  // namespace kaustik::pbrt
