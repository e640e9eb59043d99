#pragma once
// Rewrites pbrt-v3's directives as pbrt-v4's, so that later stages need not know v3.

#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "apps/import/pbrt/v3/extras.h"
#include "core/diagnostics/diagnostics.h"
#include "core/scene/description/description.h"

namespace kaustik::pbrt {

class V3Upgrader {
 public:
  explicit V3Upgrader(DiagnosticList& diagnostics) : diagnostics_(diagnostics) {}

  // Materials of v3 (matte, plastic, glass, metal, uber, substrate, translucent, disney, kdsubsurface,
  // fourier, mix of two names, none) become the nearest v4 materials, types and parameters get their new
  // names, and parameters that v4 dropped are removed. Each change gives one warning. v4 directives stay
  // unchanged. `word`: the directive, "Material", ...
  void upgrade(std::string_view word, Directive& directive);
  // What the last material became besides a material.
  V3Extras take_extras() { return std::exchange(extras_, {}); }

 private:
  void upgrade_material(Directive& m);
  void add_film_defaults(Directive& film);
  void add_medium_defaults(Directive& medium);
  void upgrade_film(Directive& film);
  void upgrade_camera(Directive& camera);
  void upgrade_shape(Directive& shape);
  void upgrade_light(Directive& light);
  void fold_intensity(Directive& light);
  void upgrade_uv(Directive& texture);
  void upgrade_texture(Directive& texture);
  void rename_type(std::string_view word, std::string_view from, std::string_view to, Directive& d);
  void rename(std::string_view word, std::string_view from, std::string_view to, Directive& d);
  void drop(std::string_view word, std::string_view name, std::string_view why, Directive& d);
  void warn_once(const std::string& key, const SourceLocation& where, std::string message);

  DiagnosticList& diagnostics_;
  V3Extras extras_;
  std::set<std::string> warned_;
};

}  // namespace kaustik::pbrt
