#include "tests/fuzz/mutator/pbrt_mutator.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/scene/schema/schema.h"
#include "tests/fuzz/mutator/pbrt_text.h"
#include "tests/support/random.h"

namespace kaustik::fuzz {

namespace {

// Numbers at the limits of the types that readers may convert them to, and small ones that are valid often.
constexpr std::string_view kNumbers[] = {
    "0",          "1",           "-1",         "2",          "3",      "0.5",   "-0.5",   "1e-3",
    "7",          "16",          "100",        "1000",       "65536",  "1e6",   "1e10",   "1e19",
    "1e38",       "1e39",        "1e154",      "1e308",      "-1e308", "1e-38", "1e-320", "1e400",
    "2147483647", "-2147483648", "4294967295", "4294967296", "nan",    "-0",    "1e-400", "9007199254740992"};

// Files beside the scene (tests/fuzz/targets/pbrt.cpp), a file that is not there, and values of strings.
constexpr std::string_view kTexts[] = {"mesh.ply",    "tiles.png",  "light.exr", "light.spd",    "part.pbrt",
                                       "none",        "",           "repeat",    "clamp",        "black",
                                       "bilinear",    "EWA",        "planar",    "spherical",    "uv",
                                       "cylindrical", "metal-Cu-k", "glass-BK7", "stdillum-D65", "sRGB"};

constexpr std::string_view kWords[] = {"WorldBegin",
                                       "AttributeBegin",
                                       "AttributeEnd",
                                       "ReverseOrientation",
                                       "Identity",
                                       "Translate 1 2 3",
                                       "Scale 2 2 -2",
                                       "Scale 0 0 0",
                                       "Rotate 90 1 0 0",
                                       "Rotate 30 0 0 0",
                                       "ObjectEnd",
                                       "WorldEnd",
                                       "TransformBegin",
                                       "TransformEnd",
                                       "ObjectBegin \"o\"",
                                       "ObjectInstance \"o\"",
                                       "LookAt 0 0 1 0 0 1 0 1 0",
                                       "Include \"part.pbrt\"",
                                       "Import \"part.pbrt\"",
                                       "NamedMaterial \"m\"",
                                       "CoordinateSystem \"c\"",
                                       "CoordSysTransform \"c\"",
                                       "ActiveTransform EndTime",
                                       "ColorSpace \"rec2020\""};

class PbrtMutator {
 public:
  PbrtMutator(PbrtText text, uint32_t seed) : text_(std::move(text)), random_(seed) {}

  PbrtText mutated() {
    for (size_t changes = 1 + below(4); changes > 0; --changes) change();
    return std::move(text_);
  }
  PbrtText spliced(const PbrtText& from) {
    if (from.empty()) return std::move(text_);
    const size_t first = below(from.size()), count = 1 + below(std::min<size_t>(from.size() - first, 8));
    const auto begin = from.begin() + std::ptrdiff_t(first);
    const auto at = text_.begin() + std::ptrdiff_t(below(text_.size() + 1));
    text_.insert(below(2) == 0 && at != text_.end() ? text_.erase(at) : at, begin,
                 begin + std::ptrdiff_t(count));
    return std::move(text_);
  }

 private:
  size_t below(size_t n) { return n == 0 ? 0 : random_.bits() % n; }
  template <class List>
  auto& any(List& list) {
    return list[below(std::size(list))];
  }

  void change() {
    if (text_.empty()) return insert_directive();
    PbrtDirective& directive = any(text_);
    const size_t kind = below(10);
    if (kind < 2) return change_directives();
    if (kind == 2) return insert_directive();
    if (kind == 3) return change_arguments(directive);
    if (kind < 6 || directive.parameters.empty()) return change_parameters(directive);
    change_values(any(directive.parameters));
  }

  void change_directives() {
    const size_t i = below(text_.size()), j = below(text_.size());
    switch (below(4)) {
      case 0:
        return std::swap(text_[i], text_[j]);
      case 1: {
        const PbrtDirective copy = text_[i];
        text_.insert(text_.begin() + std::ptrdiff_t(j), copy);
        return;
      }
      case 2:
        text_.erase(text_.begin() + std::ptrdiff_t(i));
        return;
      default:
        std::swap(text_[i].parameters, text_[j].parameters);
    }
  }

  // A word with its arguments, or a directive of the schema with some of its parameters.
  void insert_directive() {
    PbrtDirective made;
    const Category& category = any(categories());
    if (below(4) == 0 || category.types.empty()) {
      made.word = any(kWords);
    } else {
      const TypeSpec& type = *any(category.types);
      made.word = category.directive;
      if (made.word == "Texture") {
        made.arguments.push_back(below(2) == 0 ? "\"t\"" : "\"u\"");
        made.arguments.push_back(below(2) == 0 ? "\"float\"" : "\"spectrum\"");
      }
      if (!type.name.empty()) made.arguments.push_back(quoted(type.name));
      for (size_t count = below(4); count > 0 && !type.parameters.empty(); --count)
        made.parameters.push_back(make_parameter(any(type.parameters)));
    }
    text_.insert(text_.begin() + std::ptrdiff_t(below(text_.size() + 1)), std::move(made));
  }

  void change_arguments(PbrtDirective& directive) {
    if (directive.arguments.empty()) {
      directive.word = any(text_).word;
      return;
    }
    std::string& argument = any(directive.arguments);
    const Category* category = category_of(directive.word);
    if (!argument.starts_with('"'))
      argument = any(kNumbers);
    else if (category && !category->types.empty() && below(4) != 0)
      argument = quoted(any(category->types)->name);
    else
      argument = name_of_scene();
  }

  void change_parameters(PbrtDirective& directive) {
    std::vector<PbrtParameter>& parameters = directive.parameters;
    const TypeSpec* type = type_of(directive);
    const size_t kind = parameters.empty() ? 0 : below(6);
    if (kind == 0) {
      if (type && !type->parameters.empty()) parameters.push_back(make_parameter(any(type->parameters)));
      return;
    }
    PbrtParameter& parameter = any(parameters);
    switch (kind) {
      case 1:
        return std::swap(parameter, any(parameters));
      case 2: {
        const PbrtParameter copy = parameter;
        parameters.push_back(copy);
        return;
      }
      case 3:
        parameters.erase(parameters.begin() + (&parameter - parameters.data()));
        return;
      case 4:
        if (type && !type->parameters.empty())
          parameter = {declaration_of(any(type->parameters)), parameter.values};
        return;
      default:
        parameter = {declaration_of(any(any(text_).parameters, parameter)), any(text_).arguments};
    }
  }

  void change_values(PbrtParameter& parameter) {
    std::vector<std::string>& values = parameter.values;
    if (values.empty()) {
      values.emplace_back(any(kNumbers));
      return;
    }
    const size_t i = below(values.size());
    switch (below(6)) {
      case 0:
        values.erase(values.begin() + std::ptrdiff_t(i));
        return;
      case 1: {  // twice as many, up to 64
        const size_t size = std::min<size_t>(values.size(), 64);
        for (size_t k = 0; k < size; ++k) values.push_back(std::string(values[k]));
        return;
      }
      case 2:
        return std::swap(values[i], any(values));
      default:
        values[i] = values[i].starts_with('"') ? name_of_scene() : std::string(any(kNumbers));
    }
  }

  static std::string quoted(std::string_view text) { return '"' + std::string(text) + '"'; }

  static const Category* category_of(std::string_view word) {
    for (const Category& category : categories())
      if (category.directive == word) return &category;
    return nullptr;
  }
  // The row of a directive's type, or another one of its kind; null for words that have no types.
  const TypeSpec* type_of(const PbrtDirective& directive) {
    const Category* category = category_of(directive.word);
    if (!category || category->types.empty()) return nullptr;
    for (const TypeSpec* type : category->types)
      if (!directive.arguments.empty() && directive.arguments.back() == quoted(type->name)) return type;
    return any(category->types);
  }

  std::string declaration_of(const ParameterSpec& spec) {
    const std::string_view type = spec.types.empty() ? "float" : parameter_type_name(any(spec.types));
    return std::string(type) + ' ' + std::string(spec.name);
  }
  std::string declaration_of(const PbrtParameter& parameter) { return parameter.declaration; }
  // One of the parameters, or `otherwise` if there are none.
  const PbrtParameter& any(const std::vector<PbrtParameter>& list, const PbrtParameter& otherwise) {
    return list.empty() ? otherwise : list[below(list.size())];
  }

  // A parameter with as many values as the schema wants, mostly of valid size.
  PbrtParameter make_parameter(const ParameterSpec& spec) {
    PbrtParameter out{declaration_of(spec), {}};
    const bool text = out.declaration.starts_with("string") || out.declaration.starts_with("texture");
    const bool flag = out.declaration.starts_with("bool");
    const ParameterType type = spec.types.empty() ? ParameterType::kFloat : spec.types.front();
    const size_t items =
        std::max<size_t>(spec.min_items, 1) + (spec.max_items > spec.min_items ? below(4) : 0);
    const size_t count = text || flag ? items : items * numbers_per_item(type);
    for (size_t i = 0; i < std::min<size_t>(count, 64); ++i) {
      if (text)
        out.values.push_back(name_of_scene());
      else if (flag)
        out.values.emplace_back(below(2) == 0 ? "true" : "false");
      else
        out.values.emplace_back(kNumbers[below(below(4) == 0 ? std::size(kNumbers) : 11)]);
    }
    return out;
  }

  // A string of the scene, or one that means something to a reader.
  std::string name_of_scene() {
    if (text_.empty()) return quoted(any(kTexts));
    const PbrtDirective& directive = any(text_);
    if (below(2) == 0 || directive.arguments.empty()) return quoted(any(kTexts));
    const std::string& argument = any(directive.arguments);
    return argument.starts_with('"') ? argument : quoted(argument);
  }

  PbrtText text_;
  test::Random random_;
};

// The text without the directives at its end, one a line, that would make it longer than max_size.
std::string fitting(const PbrtText& directives, size_t max_size) {
  std::string text = put_together(directives);
  if (text.size() > max_size) text.resize(max_size == 0 ? 0 : text.rfind('\n', max_size - 1) + 1);
  return text;
}

}  // namespace

std::string mutate_pbrt(std::string_view text, size_t max_size, uint32_t seed) {
  return fitting(PbrtMutator(take_apart(text), seed).mutated(), max_size);
}

std::string splice_pbrt(std::string_view into, std::string_view from, size_t max_size, uint32_t seed) {
  return fitting(PbrtMutator(take_apart(into), seed).spliced(take_apart(from)), max_size);
}

}  // namespace kaustik::fuzz
