#pragma once
// Reads directives that pbrt itself would only warn about: what the schema would refuse becomes the nearest
// thing that it takes, with a warning.

#include <string_view>

#include "apps/import/common/counted_warnings.h"
#include "core/scene/schema/schema.h"

namespace kaustik::pbrt {

// Replaces a type that is unknown to the schema by its stand-in: the default for samplers, films, pixel
// filters and accelerators, "diffuse" for materials, grey for textures of colours. Cameras, shapes and lights
// have none: the picture would be of another scene. Returns what stands in, such as `"diffuse"`, or an empty
// text. `word`: the directive, "Material", ...
std::string replace_unknown_type(std::string_view word, Directive& directive);

// Replaces a measured BSDF by a material of the kind that its file's name says: metal, glass or a coated
// surface. Returns what stands in; empty, with nothing changed, if the name says nothing.
std::string replace_measured(Directive& material);

// Reads a value of another type as one that the row takes: a number as a colour of three equal ones, a real
// number as an integer, a colour as its mean, and so on. Returns false if there is no sensible reading; the
// schema check reports that.
bool change_type(const ParameterSpec& spec, Parameter& parameter);

// Reads the directive as the schema would have it. Each kind of change is a warning, reported once with its
// count.
class Repairs {
 public:
  explicit Repairs(CountedWarnings& warnings) : warnings_(warnings) {}

  // The directive must have been brought to pbrt-v4's words. Leaves spectra to the ColourReducer, and what it
  // cannot repair to the schema check. `word`: the directive, "Material", ...
  void repair(std::string_view word, Directive& directive);

 private:
  const TypeSpec* type_of(const Category& category, Directive& directive);
  void replace_file(Directive& material);
  bool is_useless(const Category& category, const TypeSpec& type, const Directive& d, const Parameter& p);
  void take_values(const Category& category, const TypeSpec& type, const ParameterSpec& spec, Parameter& p);
  void clamp(const Category& category, const TypeSpec& type, const ParameterSpec& spec, Parameter& p);

  CountedWarnings& warnings_;
};

}  // namespace kaustik::pbrt
