#include "apps/import/pbrt/v3/uber.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/import/pbrt/v3/material_edits.h"

namespace kaustik::pbrt {

using namespace v3;

namespace {

constexpr double kDefaultK = 0.25;  // of Kd and Ks in v3

// The lobes that are not black.
struct UberLobes {
  bool Kd, Ks, Kr, Kt;
};

// The largest component of a colour; `otherwise` for textures and spectra.
double largest(const Directive& d, std::string_view name, double otherwise) {
  const Parameter* p = d.find(name);
  if (!p || p->type != ParameterType::kRgb || p->numbers.empty()) return otherwise;
  return std::clamp(*std::max_element(p->numbers.begin(), p->numbers.end()), 0.0, 1.0);
}

void set_black(Directive& d, std::string_view name) {
  erase(d, {name});
  add(d, ParameterType::kRgb, name, {0, 0, 0});
}

// Adds the glossy reflection to that of the mirror, which is smooth.
void join_reflections(Directive& d, const UberLobes& have) {
  if (!have.Kr) {
    erase(d, {"Kr"});
    rename(d, "Ks", "Kr");
    set_default(d, "Kr", kDefaultK);
    return;
  }
  const Parameter* const Ks = d.find("Ks");
  Parameter* const Kr = d.find("Kr");
  for (size_t i = 0; i < Kr->numbers.size() && Kr->type == ParameterType::kRgb; ++i) {
    if (!Ks) Kr->numbers[i] += kDefaultK;
    if (Ks && Ks->type == ParameterType::kRgb && i < Ks->numbers.size()) Kr->numbers[i] += Ks->numbers[i];
  }
}

// A boundary that reflects Kr and Ks and refracts Kt. It is rough if there is nothing but Ks.
void make_boundary(Directive& d, const UberLobes& have) {
  if (have.Ks) join_reflections(d, have);
  if (!have.Ks && !have.Kr) set_black(d, "Kr");
  if (!have.Kt) set_black(d, "Kt");
  if (have.Ks && !have.Kr && !have.Kt)
    keep_width(d, 0.1);
  else
    make_smooth(d);
  d.type = "dielectric";
  erase(d, {"Kd", "Ks"});
  rename(d, "Kr", "reflectance");
  rename(d, "Kt", "transmittance");
  for (const std::string_view tint : {"reflectance", "transmittance"}) scale_colour(d, tint, 1);
}

// Kd alone or under a coat, which is smooth if there is a mirror.
void make_diffuse(Directive& d, const UberLobes& have) {
  if (have.Kr) {
    make_smooth(d);
    make_coated(d, kDefaultK, 0);
    make_smooth(d);
  } else if (have.Ks) {
    make_coated(d, kDefaultK, 0.1);
  } else {
    d.type = "diffuse";
    make_smooth(d);
    rename(d, "Kd", "reflectance");
    set_default(d, "reflectance", kDefaultK);
    erase(d, {"Ks", "eta"});
  }
  erase(d, {"Kr", "Kt"});
}

// A mixture of both, each with the light of its share. Textures cannot be scaled here, so with them the sum
// is somewhat too dark.
void make_mixture(Directive& d, const UberLobes& have, V3Extras* extras) {
  const double Kt = largest(d, "Kt", 0.5), Kd = largest(d, "Kd", d.find("Kd") ? 1 - Kt : kDefaultK);
  const double share = std::clamp(Kt / (Kt + Kd), 0.05, 0.95);
  MaterialDescription parts[2];
  const std::string_view names[] = {"diffuse part", "glass part"};
  for (size_t i = 0; i < 2; ++i) {
    static_cast<Directive&>(parts[i]) = d;
    parts[i].name = fmt::format("uber at {}:{}:{}, {}", d.type_location.file, d.type_location.line,
                                d.type_location.column, names[i]);
    parts[i].name_location = d.type_location;
  }
  make_diffuse(parts[0], {have.Kd, have.Ks, false, false});
  scale_colour(parts[0], "reflectance", 1 / (1 - share));
  make_boundary(parts[1], {false, false, have.Kr, have.Kt});
  for (const std::string_view tint : {"reflectance", "transmittance"})
    scale_colour(parts[1], tint, 1 / share);
  d.type = "mix";
  d.parameters.clear();
  add(d, ParameterType::kFloat, "amount", {share});
  add(d, ParameterType::kString, "materials", {}).strings = {parts[0].name, parts[1].name};
  for (MaterialDescription& part : parts) extras->parts.push_back(std::move(part));
}

}  // namespace

std::string upgrade_uber(Directive& d, V3Extras* extras) {
  const UberLobes have{!is_black(d, "Kd", false), !is_black(d, "Ks", false), !is_black(d, "Kr", true),
                       !is_black(d, "Kt", true)};
  rename(d, "index", "eta");
  if (const Parameter* opacity = d.find("opacity")) extras->opacity = *opacity;
  const std::string see_through = extras->opacity ? "; `opacity` becomes the `alpha` of its shapes" : "";
  erase(d, {"opacity"});
  if (have.Kd && have.Kt) {
    make_mixture(d, have, extras);
    return "a \"mix\" of a diffuse surface and tinted glass" + see_through;
  }
  const bool glass = !have.Kd && (have.Ks || have.Kr || have.Kt);
  if (glass)
    make_boundary(d, have);
  else
    make_diffuse(d, have);
  const std::string coat = have.Kr ? "`Kr` and `Ks` are ignored" : "`Ks` is ignored";
  if (glass) return "a \"dielectric\" that `Kr` and `Kt` tint" + see_through;
  if (d.type == "diffuse") return "\"diffuse\"" + see_through;
  return "\"coateddiffuse\": the coat reflects by the Fresnel equations, and " + coat + see_through;
}

}  // namespace kaustik::pbrt
