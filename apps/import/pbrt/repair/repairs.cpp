#include "apps/import/pbrt/repair/repairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/diagnostics/nearest_name.h"

namespace kaustik::pbrt {
namespace {

const Category* category_of(std::string_view word) {
  for (const Category& c : categories()) {
    if (c.directive == word) return &c;
  }
  return nullptr;
}

const TypeSpec* find_row(const Category& category, std::string_view type) {
  const auto found = std::find_if(category.types.begin(), category.types.end(),
                                  [&](const TypeSpec* t) { return t->name == type; });
  return found == category.types.end() ? nullptr : *found;
}

// Whether the name is one of the others with one or two letters wrong: then the picture would lack what its
// author wrote, and the schema check says so.
bool is_misspelt(std::string_view name, const std::vector<std::string_view>& names) {
  constexpr size_t kShortest = 5, kMostErrors = 2;
  const auto nearest = nearest_name(name, names);
  if (name.size() < kShortest || !nearest) return false;
  const size_t errors = edit_distance(name, *nearest);
  return errors > 0 && errors <= kMostErrors;
}

std::vector<std::string_view> names_of_types(const Category& category) {
  std::vector<std::string_view> names;
  for (const TypeSpec* t : category.types) names.push_back(t->name);
  return names;
}

std::string owner_of(const Category& category, const TypeSpec& type) {
  return fmt::format("{} \"{}\"", category.noun, type.name);
}

std::vector<std::string_view> names_of_parameters(const TypeSpec& type) {
  std::vector<std::string_view> names;
  for (const ParameterSpec& spec : type.parameters) {
    if (spec.state == ParameterState::kUsed) names.push_back(spec.name);
  }
  return names;
}

bool takes_type(const ParameterSpec& spec, const Parameter& p) {
  return std::find(spec.types.begin(), spec.types.end(), p.type) != spec.types.end();
}

// A colour may be given by one number or three where the row takes numbers, too.
bool has_good_count(const ParameterSpec& spec, const Parameter& p) {
  const size_t n = numbers_per_item(p.type);
  if (spec.max_items != 1) return true;
  if (p.type == ParameterType::kFloat && spec.types.front() == ParameterType::kRgb)
    return p.count() == 1 || p.count() == 3;
  return p.count() == n;
}

bool is_spectral(const Parameter& p) {
  return p.type == ParameterType::kSpectrum || p.type == ParameterType::kBlackbody;
}

}  // namespace

const TypeSpec* Repairs::type_of(const Category& category, Directive& d) {
  if (const TypeSpec* known = find_row(category, d.type)) return known;
  const std::string from = d.type.substr(0, 60);
  const std::vector<std::string_view> names = names_of_types(category);
  const bool shows = category.directive == "Material" || category.directive == "Texture";
  if (shows && is_misspelt(from, names)) return nullptr;
  const std::string to = replace_unknown_type(category.directive, d);
  if (to.empty()) return nullptr;
  warnings_.say_one_of(
      fmt::format("type/{}/{}", category.noun, from), d.type_location,
      fmt::format("unknown {} \"{}\": {} stands in{}", category.noun, from, to, name_hint(from, names)));
  return find_row(category, d.type);
}

void Repairs::replace_file(Directive& material) {
  const SourceLocation where = material.type_location;
  const Parameter* file = material.find("filename");
  const std::string name = file && !file->strings.empty() ? file->strings[0].substr(0, 60) : "";
  const std::string to = replace_measured(material);
  if (to.empty()) return;
  warnings_.say_one_of(
      "measured/" + name, where,
      fmt::format("the measured BSDF \"{}\" is not read: {} stands in, after the file's name", name, to));
}

// Tells, with a warning, whether a parameter is to be left out: the type does not take it or its
// texture, or it is empty.
bool Repairs::is_useless(const Category& category, const TypeSpec& type, const Directive& d,
                         const Parameter& p) {
  const ParameterSpec* spec = type.find(p.name);
  const std::string cause = fmt::format("parameter/{}/{}/{}", category.noun, type.name, p.name);
  if (!spec && !p.inherited) {
    std::vector<std::string_view> names = names_of_parameters(type);
    std::vector<std::string_view> missing = names;
    std::erase_if(missing, [&](std::string_view name) { return d.find(name) != nullptr; });
    if (is_misspelt(p.name, missing)) return false;
    warnings_.say_one_of(cause, p.location,
                         fmt::format("{} has no parameter `{}`, which is ignored{}", owner_of(category, type),
                                     p.name, name_hint(p.name, names)));
    return true;
  }
  if (spec && spec->state == ParameterState::kUsed && p.type == ParameterType::kTexture &&
      !takes_type(*spec, p)) {
    warnings_.say_one_of(
        cause, p.location,
        fmt::format("`{}` of {} takes no texture and keeps its default", p.name, owner_of(category, type)));
    return true;
  }
  const bool list = spec && spec->max_items != 1;
  if (!spec || spec->state != ParameterState::kUsed || p.count() > 0 || list) return false;
  warnings_.say_one_of(
      cause, p.location,
      fmt::format("`{}` of {} has no value and is ignored", p.name, owner_of(category, type)));
  return true;
}

void Repairs::take_values(const Category& category, const TypeSpec& type, const ParameterSpec& spec,
                          Parameter& p) {
  if (takes_type(spec, p) && has_good_count(spec, p)) return;
  const std::string given = fmt::format("\"{} {}\"", parameter_type_name(p.type), p.name);
  const size_t count = p.count();
  if (!change_type(spec, p)) return;
  const std::string how = p.count() >= count ? "" : fmt::format(" with {} values", count);
  warnings_.say_one_of(fmt::format("type of/{}/{}/{}", category.noun, type.name, p.name), p.location,
                       fmt::format("{}{} of {} is read as \"{} {}\"", given, how, owner_of(category, type),
                                   parameter_type_name(p.type), p.name));
}

// Moves values to the nearest bound that is allowed, as pbrt does with reflectances.
void Repairs::clamp(const Category& category, const TypeSpec& type, const ParameterSpec& spec, Parameter& p) {
  for (size_t i = 0; i < p.numbers.size(); ++i) {
    double& v = p.numbers[i];
    const bool low = v < spec.range.low && !spec.range.low_open;
    const bool high = v > spec.range.high && !spec.range.high_open;
    if (!low && !high) continue;
    const double before = std::exchange(v, low ? spec.range.low : spec.range.high);
    warnings_.say_one_of(fmt::format("range of/{}/{}/{}", category.noun, type.name, p.name),
                         p.value_location(i),
                         fmt::format("`{}` of {} must be {}: {} becomes {}", p.name, owner_of(category, type),
                                     spec.range.text(), before, v));
  }
}

void Repairs::repair(std::string_view word, Directive& d) {
  if (word == "Material") replace_file(d);
  const Category* category = category_of(word);
  const TypeSpec* type = category ? type_of(*category, d) : nullptr;
  if (!type) return;
  std::erase_if(d.parameters, [&](const Parameter& p) { return is_useless(*category, *type, d, p); });
  // The view of the picture, its light and the number of samples are never guessed.
  const bool may_clamp = word == "Material" || word == "Texture" || word == "Shape";
  for (Parameter& p : d.parameters) {
    const ParameterSpec* spec = type->find(p.name);
    if (!spec || spec->state != ParameterState::kUsed || is_spectral(p)) continue;
    take_values(*category, *type, *spec, p);
    if (may_clamp && p.type != ParameterType::kTexture) clamp(*category, *type, *spec, p);
  }
}

}  // namespace kaustik::pbrt
