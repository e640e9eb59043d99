// What stands in for types that the schema does not know, and how values of one type are read as another.

#include <algorithm>
#include <cmath>

#include "apps/import/pbrt/repair/repairs.h"
#include "core/text.h"

namespace kaustik::pbrt {
namespace {

using Type = ParameterType;

bool is_numeric(Type type) {
  return type != Type::kString && type != Type::kTexture && type != Type::kSpectrum &&
         type != Type::kBlackbody;
}

void keep_only(Directive& d, std::initializer_list<std::string_view> names) {
  std::erase_if(d.parameters, [&](const Parameter& p) {
    return std::find(names.begin(), names.end(), p.name) == names.end();
  });
}

// Keeps the colour of a material, whatever it is called, and its bumps.
void keep_colour(Directive& material) {
  for (const std::string_view name : {"reflectance", "Kd", "color", "diffuse", "albedo", "Kr", "Ks"}) {
    Parameter* p = material.find(name);
    if (!p || p->type == Type::kString || p->type == Type::kFloat) continue;
    p->name = "reflectance";
    break;
  }
  if (Parameter* bumps = material.find("bumpmap")) bumps->name = "displacement";
  keep_only(material, {"reflectance", "displacement", "normalmap"});
}

// pbrt-v2's adaptive samplers have a smallest and a largest number of samples.
void keep_sample_count(Directive& sampler) {
  Parameter* most = sampler.find("maxsamples");
  if (most && !sampler.find("pixelsamples")) most->name = "pixelsamples";
  keep_only(sampler, {"pixelsamples"});
}

// The longest known material with which the name begins, in any case, as in "subsurfaceSPPM"; empty if none.
std::string known_beginning(std::string_view name) {
  const std::string lower = lower_case(name);
  std::string longest;
  for (const TypeSpec* type : category("Material").types) {
    if (lower.starts_with(type->name) && type->name.size() > longest.size()) longest = type->name;
  }
  return longest;
}

double mean(const std::vector<double>& numbers) {
  double sum = 0;
  for (const double v : numbers) sum += v;
  return sum / double(numbers.size());
}

// Reads numbers as one of the types that hold numbers. `whole`: all are integers.
bool read_numbers(Type to, bool single, bool whole, Parameter& p) {
  std::vector<double>& v = p.numbers;
  const size_t n = numbers_per_item(to);
  if (to == Type::kRgb && single) {
    if (v.size() == 4) v.pop_back();  // the fourth is an alpha
    if (v.size() == 1) v.assign(3, v[0]);
    return v.size() == 3;
  }
  if (n > 1) return v.size() % n == 0;
  if (single && v.size() > 1) v = {p.type == Type::kRgb ? mean(v) : v[0]};
  if (to == Type::kInteger && !whole)
    for (double& x : v) x = std::round(x);
  if (to == Type::kBool)
    for (double& x : v) x = x != 0 ? 1 : 0;
  return true;
}

// "true" and "false" in quotes are truth values to exporters.
bool read_words(Parameter& p) {
  if (p.strings.size() != 1 || (p.strings[0] != "true" && p.strings[0] != "false")) return false;
  p.numbers = {p.strings[0] == "true" ? 1.0 : 0.0};
  p.strings.clear();
  return true;
}

}  // namespace

std::string replace_unknown_type(std::string_view word, Directive& d) {
  if (word == "Sampler") {
    keep_sample_count(d);
    d.type = "zsobol";
    return "\"zsobol\"";
  }
  if (word == "Accelerator" || word == "PixelFilter") {
    d.parameters.clear();
    d.type = word == "Accelerator" ? "bvh" : "gaussian";
    return "\"" + d.type + "\"";
  }
  if (word == "Film") {
    d.type = "rgb";
    return "\"rgb\"";
  }
  if (word == "Material") {
    if (const std::string known = known_beginning(d.type); !known.empty()) {
      d.type = known;
      return "\"" + known + "\"";
    }
    if (d.type == "shinymetal") {  // pbrt-v2's
      if (Parameter* colour = d.find("Kr")) colour->name = "reflectance";
      keep_only(d, {"reflectance", "roughness"});
      d.type = "conductor";
      return "\"conductor\"";
    }
    keep_colour(d);
    d.type = "diffuse";
    return "\"diffuse\"";
  }
  if (word == "Texture") {
    d.type = "constant";
    keep_only(d, {"value"});
    if (d.parameters.empty()) {
      Parameter grey;
      grey.name = "value";
      grey.location = d.type_location;
      grey.numbers = {0.5};
      d.parameters.push_back(std::move(grey));
    }
    return "a grey of 0.5";
  }
  return "";
}

bool change_type(const ParameterSpec& spec, Parameter& p) {
  const auto takes = [&](Type t) {
    return std::find(spec.types.begin(), spec.types.end(), t) != spec.types.end();
  };
  const bool single = spec.max_items == 1;
  const bool whole =
      std::all_of(p.numbers.begin(), p.numbers.end(), [](double v) { return v == std::floor(v); });
  if (p.type == Type::kString && takes(Type::kBool) && read_words(p)) {
    p.type = Type::kBool;
  } else if (is_numeric(p.type) && !p.numbers.empty()) {
    const auto to = std::find_if(spec.types.begin(), spec.types.end(), is_numeric);
    if (to == spec.types.end() || !read_numbers(*to, single, whole, p)) return false;
    p.type = *to;
  } else {
    return false;
  }
  const size_t places = single ? 1 : p.numbers.size();
  p.value_places.resize(std::min(p.value_places.size(), places));
  return true;
}

}  // namespace kaustik::pbrt
