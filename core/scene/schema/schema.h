#pragma once
// What a scene may say: one table per kind of directive, one row per type, one entry per parameter. The
// checks, the error messages, the defaults and the tables of docs/reference/scene_format.md all come from
// here. A new material is a row of schema.cpp, a light one of light_rows.cpp; the row holds the function that
// makes it from its parameters. from its parameters.

#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics/diagnostics.h"
#include "core/light/light.h"
#include "core/scene/description/description.h"
#include "core/scene/material.h"

namespace kaustik {

enum class ParameterState {
  kUsed,
  kIgnored  // pbrt knows it, the picture is made without it: one warning
};

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;

  bool contains(double v) const {
    return (low_open ? v > low : v >= low) && (high_open ? v < high : v <= high);
  }
  // ">= 0", "> 0 and < 180"; empty for all numbers.
  std::string text() const;
};

struct ParameterSpec {
  std::string_view name;
  std::vector<ParameterType> types;  // accepted ones
  // How many items: an rgb is one item of three numbers.
  size_t min_items = 1, max_items = 1;
  std::vector<double> defaults;   // numbers; empty: none, or as default_text says
  std::string_view default_text;  // shown instead of the numbers
  std::string_view unit;
  Range range;  // of each number
  std::string_view doc;
  ParameterState state = ParameterState::kUsed;
  // Value at which an unused parameter changes nothing: accepted in silence.
  std::optional<double> neutral;
};

struct TypeSpec {
  std::string_view name;
  std::string_view doc;
  std::vector<ParameterSpec> parameters;
  // For types that are taken for others: what becomes of them. One warning; empty for all others.
  std::string_view approximated = {};

  const ParameterSpec* find(std::string_view parameter_name) const;
};

// Numbers of one item: 3 of an rgb, 1 of a float or string.
size_t numbers_per_item(ParameterType type);

// Reads the values of a directive that check_parameters accepted; what is absent comes from the row's
// defaults.
class ParameterReader {
 public:
  ParameterReader(const Directive& directive, const TypeSpec& spec) : directive_(directive), spec_(spec) {}

  bool has(std::string_view name) const { return directive_.find(name) != nullptr; }
  double number(std::string_view name) const;
  bool flag(std::string_view name) const { return number(name) != 0; }
  Rgb rgb(std::string_view name) const { return Rgb(vec3(name)); }
  glm::dvec3 vec3(std::string_view name, size_t item = 0) const;
  std::string text(std::string_view name) const;  // empty when absent
  const Directive& directive() const { return directive_; }
  const TypeSpec& spec() const { return spec_; }
  // As written, or the defaults; empty when there are neither.
  const std::vector<double>& numbers(std::string_view name) const;
  // Of the parameter's first value; of the directive's type when absent.
  SourceLocation location(std::string_view name) const;

 private:
  const Directive& directive_;
  const TypeSpec& spec_;
};

struct MaterialRow {
  TypeSpec spec;
  // Null: a surface that is not there ("interface").
  BsdfMaker make = nullptr;
};

class LightImages;

// What a light is made from.
struct LightInputs {
  ParameterReader parameters;
  glm::dmat4 light_to_world{1};
  glm::dvec3 origin{0};  // of the scene (core/scene/scene.h): what is made lies relative to it
  LightImages& images;
  DiagnosticList& diagnostics;
};

struct LightRow {
  TypeSpec spec;
  // Nothing, with an error added, when the parameters contradict each other.
  std::optional<Light> (*make)(const LightInputs&) = nullptr;
};

// Lights that are surfaces get their radiance from the row; the builder adds the shape.
const std::vector<MaterialRow>& material_rows();
const std::vector<LightRow>& light_rows();
const std::vector<TypeSpec>& area_light_types();
const std::vector<TypeSpec>& texture_types();
const std::vector<TypeSpec>& shape_types();
const std::vector<TypeSpec>& camera_types();
const std::vector<TypeSpec>& film_types();
const std::vector<TypeSpec>& sampler_types();
const std::vector<TypeSpec>& filter_types();
const std::vector<TypeSpec>& accelerator_types();
// `Option` has parameters but no type.
const TypeSpec& option_type();

// A kind of directive: what its types are, and which more pbrt has.
struct Category {
  std::string_view directive;  // "Material"
  std::string_view noun;       // "material"
  std::vector<const TypeSpec*> types;
  std::vector<std::string_view> only_in_pbrt;
};
// In the order of the document.
const std::vector<Category>& categories();
const Category& category(std::string_view directive);

// Remembers which "ignored" warnings were given: one per directive, type and parameter.
using WarnedOnce = std::set<std::string>;

// The row of a directive's type, or null with an error: a type of pbrt that is not rendered, or one that
// nobody knows.
const TypeSpec* find_type(const Category& category, const Directive& directive, DiagnosticList& diagnostics);

// Checks every parameter against the row: unknown, twice, of a wrong type or count, out of range, not
// rendered (errors), ignored (warnings). noun: "material". True when there was no error.
bool check_parameters(std::string_view noun, const TypeSpec& spec, const Directive& directive,
                      WarnedOnce& warned, DiagnosticList& diagnostics);

// The tables of docs/reference/scene_format.md.
std::string schema_markdown();

}  // namespace kaustik
