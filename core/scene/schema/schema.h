#pragma once
// The schema of scene descriptions: one table per kind of directive, one row per type, one entry per
// parameter. The checks, the error messages, the defaults and the tables of docs/reference/scene_format.md
// all come from here. A new material is a row of schema.cpp, a new light one of light_rows.cpp; the row holds
// the function that makes it from its parameters.

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
  kIgnored  // known to pbrt but without effect here: one warning
};

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;

  bool contains(double v) const {
    return (low_open ? v > low : v >= low) && (high_open ? v < high : v <= high);
  }
  // For example ">= 0" or "> 0 and < 180"; empty if all numbers are allowed.
  std::string text() const;
};

struct ParameterSpec {
  std::string_view name;
  std::vector<ParameterType> types;  // accepted types
  // Number of items; an rgb is one item of three numbers.
  size_t min_items = 1, max_items = 1;
  std::vector<double> defaults;   // numbers; if empty, there is none or default_text describes it
  std::string_view default_text;  // shown in place of the numbers
  std::string_view unit;
  Range range;  // of each number
  std::string_view doc;
  ParameterState state = ParameterState::kUsed;
  // Value at which an ignored parameter would change nothing, so that it is accepted without a warning.
  std::optional<double> neutral;
};

struct TypeSpec {
  std::string_view name;
  std::string_view doc;
  std::vector<ParameterSpec> parameters;
  // For types that are approximated by others: how. Causes one warning; empty for all other types.
  std::string_view approximated = {};

  const ParameterSpec* find(std::string_view parameter_name) const;
};

// Number of values per item: 3 for an rgb, 1 for a float or string.
size_t numbers_per_item(ParameterType type);

// Reads the values of a directive that check_parameters accepted, with the row's defaults for absent
// parameters.
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
  // The values as written, or the defaults; empty if there are neither.
  const std::vector<double>& numbers(std::string_view name) const;
  // Location of the parameter's first value, or of the directive's type if the parameter is absent.
  SourceLocation location(std::string_view name) const;

 private:
  const Directive& directive_;
  const TypeSpec& spec_;
};

// All parameters of the row that have an effect, before their textures are resolved. The directive must have
// passed check_parameters.
std::vector<MaterialInput> material_inputs(const ParameterReader& parameters);

struct MaterialRow {
  TypeSpec spec;
  // Null for a surface that is not there ("interface") and for "mix".
  BsdfMaker make = nullptr;
};

class LightImages;

// The inputs from which a light is made.
struct LightInputs {
  ParameterReader parameters;
  glm::dmat4 light_to_world{1};
  glm::dvec3 origin{0};  // the scene's origin (core/scene/scene.h), to which lights are relative
  LightImages& images;
  DiagnosticList& diagnostics;
};

struct LightRow {
  TypeSpec spec;
  // Returns nothing, with an error added, if the parameters contradict each other.
  std::optional<Light> (*make)(const LightInputs&) = nullptr;
};

// The tables, one per directive. Area lights have no function here: the builder makes them from the row and
// the shape.
// A shape in its own space, before any transform; its to_world is not set yet. Never an InstancedMesh.
struct ShapeSource {
  Geometry geometry;
  // Maps to the shape's space: from the unit sphere or disk, or from a mesh's own origin.
  glm::dmat4 local{1};
};

// Input of the function that makes an analytic shape.
struct ShapeInputs {
  const ParameterReader& parameters;
  DiagnosticList& diagnostics;
};

struct ShapeRow {
  TypeSpec spec;
  // Nothing, with an error added, when the parameters contradict each other. Null for meshes, which
  // core/scene/shapes makes.
  std::optional<ShapeSource> (*make)(const ShapeInputs&) = nullptr;
};

const std::vector<MaterialRow>& material_rows();
const std::vector<LightRow>& light_rows();
const std::vector<ShapeRow>& shape_rows();
const std::vector<TypeSpec>& area_light_types();
const std::vector<TypeSpec>& texture_types();
const std::vector<TypeSpec>& medium_types();
const std::vector<TypeSpec>& camera_types();
const std::vector<TypeSpec>& film_types();
const std::vector<TypeSpec>& sampler_types();
const std::vector<TypeSpec>& filter_types();
const std::vector<TypeSpec>& accelerator_types();
// `Option` has parameters, but no type.
const TypeSpec& option_type();

// A kind of directive: its types here, and pbrt's types that are not supported.
struct Category {
  std::string_view directive;  // "Material"
  std::string_view noun;       // "material"
  std::vector<const TypeSpec*> types;
  std::vector<std::string_view> only_in_pbrt;
};
// In the order of the reference page.
const std::vector<Category>& categories();
const Category& category(std::string_view directive);

// Remembers which warnings were given: one per directive, type and parameter.
using WarnedOnce = std::set<std::string>;

// The row of a directive's type, or null with an error: a type of pbrt that is not supported, or an unknown
// type.
const TypeSpec* find_type(const Category& category, const Directive& directive, DiagnosticList& diagnostics);

// Checks every parameter against the row. Unknown or repeated parameters, a wrong type or count, values out
// of range and unsupported types are errors; ignored parameters cause warnings. noun: for example "material".
// Returns true if there was no error.
bool check_parameters(std::string_view noun, const TypeSpec& spec, const Directive& directive,
                      WarnedOnce& warned, DiagnosticList& diagnostics);

// The tables of docs/reference/scene_format.md, as Markdown.
std::string schema_markdown();

}  // namespace kaustik
