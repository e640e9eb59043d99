#include "apps/import/pbrt/v3/materials.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace kaustik::pbrt {
namespace {

void erase(Directive& d, std::initializer_list<std::string_view> names) {
  std::erase_if(d.parameters, [&](const Parameter& p) {
    return std::find(names.begin(), names.end(), p.name) != names.end();
  });
}

void rename(Directive& d, std::string_view from, std::string_view to) {
  if (Parameter* p = d.find(from); p && !d.find(to)) p->name = to;
}

Parameter& add(Directive& d, ParameterType type, std::string_view name, std::vector<double> numbers) {
  Parameter p;
  p.type = type;
  p.name = name;
  p.location = d.type_location;
  p.numbers = std::move(numbers);
  d.parameters.push_back(std::move(p));
  return d.parameters.back();
}

void set_default(Directive& d, std::string_view name, double value) {
  if (!d.find(name)) add(d, ParameterType::kRgb, name, {value, value, value});
}

// The value of a parameter with one number; `otherwise` when it is absent or a texture.
double number(const Directive& d, std::string_view name, double otherwise) {
  const Parameter* p = d.find(name);
  return p && p->numbers.size() == 1 ? p->numbers[0] : otherwise;
}

bool is_black(const Directive& d, std::string_view name, bool otherwise) {
  const Parameter* p = d.find(name);
  if (!p) return otherwise;
  return p->strings.empty() &&
         std::all_of(p->numbers.begin(), p->numbers.end(), [](double v) { return v == 0; });
}

// The GGX width of a v3 roughness: pbrt-v3's TrowbridgeReitzDistribution::RoughnessToAlpha.
double v3_alpha(double roughness) {
  const double x = std::log(std::max(roughness, 1e-3));
  return 1.62142 + 0.819955 * x + 0.1734 * x * x + 0.0171201 * x * x * x + 0.000640711 * x * x * x * x;
}

// Converts numeric roughness to GGX widths. Roughness textures stay and are mapped as in v4. `otherwise`: the
// material's default roughness in v3. `smooth_at_zero`: roughness 0 means a smooth surface.
void keep_width(Directive& d, double otherwise, bool smooth_at_zero = false) {
  bool textured = false, given = false;
  for (const std::string_view name : {"roughness", "uroughness", "vroughness"}) {
    const Parameter* p = d.find(name);
    given = given || p;
    textured = textured || (p && p->numbers.size() != 1);
  }
  if (textured) return;
  if (!given) add(d, ParameterType::kFloat, "roughness", {otherwise});
  const bool remap = number(d, "remaproughness", 1) != 0;
  erase(d, {"remaproughness"});
  add(d, ParameterType::kBool, "remaproughness", {0});
  if (!remap) return;
  for (const std::string_view name : {"roughness", "uroughness", "vroughness"}) {
    Parameter* p = d.find(name);
    if (p && !(smooth_at_zero && p->numbers[0] == 0)) p->numbers[0] = v3_alpha(p->numbers[0]);
  }
}

std::string coated(Directive& d, double diffuse, double roughness) {
  d.type = "coateddiffuse";
  rename(d, "Kd", "reflectance");
  set_default(d, "reflectance", diffuse);
  rename(d, "index", "eta");
  erase(d, {"Ks"});
  keep_width(d, roughness);
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
  return coated(d, 0.25, 0.1);
}
std::string substrate(Directive& d) {
  return coated(d, 0.5, 0.1);
}

std::string glass(Directive& d) {
  d.type = "dielectric";
  rename(d, "index", "eta");
  erase(d, {"Kr", "Kt"});
  keep_width(d, 0, true);
  return "\"dielectric\", which neither tints nor absorbs: `Kr` and `Kt` are ignored";
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

std::string uber(Directive& d) {
  const bool clear = !is_black(d, "Kt", true) && is_black(d, "Kd", false);
  if (clear) {
    erase(d, {"Kd", "Ks", "opacity"});
    glass(d);
    return "\"dielectric\" if only `Kt` is set, else \"coateddiffuse\"";
  }
  erase(d, {"Kr", "Kt", "opacity"});
  coated(d, 0.25, 0.1);
  return "\"coateddiffuse\" (\"dielectric\" if only `Kt` is set); `Kr`, `Kt` and `opacity` are "
         "ignored";
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
  if (clear) erase(d, {"reflectance"});
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

std::string upgrade_v3_material(Directive& d) {
  using Upgrade = std::string (*)(Directive&);
  static const std::map<std::string_view, Upgrade> table = {{"disney", disney},
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
                                                            {"uber", uber},
                                                            {"translucent", translucent}};
  const auto found = table.find(d.type);
  if (found == table.end()) return "";
  const std::string change = found->second(d);
  if (change.empty()) return "";
  rename(d, "bumpmap", "displacement");
  return change;
}

}  // namespace kaustik::pbrt
