// Names of textures and materials that a scene defines more than once.

#include <fmt/format.h>

#include <algorithm>

#include "apps/import/pbrt/scene_parser.h"
#include "core/diagnostics/nearest_name.h"
#include "core/scene/schema/schema.h"

namespace kaustik::pbrt {
namespace {

bool takes_number(std::string_view word, const Directive& directive, std::string_view parameter) {
  for (const TypeSpec* type : category(word).types) {
    if (type->name != directive.type) continue;
    const ParameterSpec* spec = type->find(parameter);
    return spec && !spec->types.empty() && spec->types.front() == ParameterType::kFloat;
  }
  return false;
}

void replace(const LaterNames& later, std::string& name) {
  if (const auto found = later.find(name); found != later.end()) name = found->second;
}

}  // namespace

// Registers a definition and returns its unique name: the name itself, or a new one if it is taken. In the
// rest of the block the name refers to the new definition.
std::string SceneParser::define(std::string_view what, const std::string& name, const SourceLocation& where,
                                std::set<std::string>& known, LaterNames& later) {
  if (known.insert(name).second) return name;
  std::string own;
  for (size_t n = 2; own.empty() || !known.insert(own).second; ++n) own = fmt::format("{} ({})", name, n);
  later[name] = own;
  if (warned_.insert(std::string(what)).second)
    diagnostics_.warning(
        where, fmt::format("{} `{}` is defined again, as pbrt-v3 allows: this definition holds up to the end "
                           "of the block",
                           what, name));
  return own;
}

// Replaces names that were defined again by their unique names. Whether a parameter takes a float or a
// spectrum texture follows from the type of the enclosing texture, else from the schema. A name that exists
// only as a texture of the other type is resolved as that.
void SceneParser::resolve_names(std::string_view word, Directive& directive, bool of_float_texture) const {
  if (state_.float_textures.empty() && state_.spectrum_textures.empty() && state_.materials.empty()) return;
  for (Parameter& p : directive.parameters) {
    if (p.type == ParameterType::kTexture && p.strings.size() == 1) {
      const bool number = of_float_texture || takes_number(word, directive, p.name);
      const bool is_float = float_textures_.contains(p.strings[0]);
      const bool is_spectrum = spectrum_textures_.contains(p.strings[0]);
      const bool as_float = number ? is_float || !is_spectrum : !is_spectrum;
      replace(as_float ? state_.float_textures : state_.spectrum_textures, p.strings[0]);
    } else if (word == "Material" && p.name == "materials") {
      for (std::string& name : p.strings) replace(state_.materials, name);
    }
  }
}

// As in pbrt-v3, a parameter whose texture is not defined up to here keeps its default.
void SceneParser::leave_out_unknown_textures(Directive& directive) {
  std::erase_if(directive.parameters, [&](const Parameter& p) {
    if (p.type != ParameterType::kTexture || p.strings.size() != 1) return false;
    const std::string& name = p.strings[0];
    if (float_textures_.contains(name) || spectrum_textures_.contains(name)) return false;
    const auto names = [&] {
      std::vector<std::string_view> all(spectrum_textures_.begin(), spectrum_textures_.end());
      all.insert(all.end(), float_textures_.begin(), float_textures_.end());
      return all;
    };
    repeated_.say_one_of("texture/" + name, p.value_location(0),
                         fmt::format("no texture is named `{}` up to here: `{}` keeps its default{}", name,
                                     p.name, diagnostics_.hint(name, names)));
    return true;
  });
}

}  // namespace kaustik::pbrt
