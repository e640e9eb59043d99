#include "apps/import/pbrt/v3/material_edits.h"

#include <algorithm>
#include <cmath>

namespace kaustik::pbrt::v3 {

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
static double v3_alpha(double roughness) {
  const double x = std::log(std::max(roughness, 1e-3));
  return 1.62142 + 0.819955 * x + 0.1734 * x * x + 0.0171201 * x * x * x + 0.000640711 * x * x * x * x;
}

void keep_width(Directive& d, double otherwise, bool smooth_at_zero) {
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

void scale_colour(Directive& d, std::string_view name, double factor) {
  Parameter* p = d.find(name);
  if (!p || (p->type != ParameterType::kRgb && p->type != ParameterType::kFloat)) return;
  for (double& v : p->numbers) v = std::clamp(v * factor, 0.0, 1.0);
}

void make_smooth(Directive& d) {
  erase(d, {"roughness", "uroughness", "vroughness", "remaproughness"});
}

void make_coated(Directive& d, double diffuse, double roughness) {
  d.type = "coateddiffuse";
  rename(d, "Kd", "reflectance");
  set_default(d, "reflectance", diffuse);
  rename(d, "index", "eta");
  erase(d, {"Ks"});
  keep_width(d, roughness);
}

}  // namespace kaustik::pbrt::v3
