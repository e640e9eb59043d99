// Makes media from their directives, and finds them by name.

#include "core/scene/build/medium_table.h"

#include <fmt/format.h>

#include "core/diagnostics/nearest_name.h"

namespace kaustik {

MediumTable::MediumTable(const SceneDescription& description, WarnedOnce& warned,
                         DiagnosticList& diagnostics) {
  std::map<std::string_view, SourceLocation> first_place;
  for (const MediumDescription& medium : description.media) {
    const auto [first, is_new] = first_place.emplace(medium.name, medium.name_location);
    if (!is_new)
      diagnostics.error(medium.name_location, fmt::format("medium `{}` is defined twice", medium.name),
                        {{first->second, "first defined here"}});
    by_name_.emplace(medium.name, make(medium, warned, diagnostics));
  }
}

MediumIndex MediumTable::make(const MediumDescription& description, WarnedOnce& warned,
                              DiagnosticList& diagnostics) {
  const TypeSpec* spec = find_type(category("MakeNamedMedium"), description, diagnostics);
  if (!spec || !check_parameters("medium", *spec, description, warned, diagnostics)) return kVacuum;
  const ParameterReader p(description, *spec);
  const auto scale = static_cast<float>(p.number("scale"));
  const Medium medium{scale * p.rgb("sigma_a")};
  if (scale > 0 && !is_black(p.rgb("sigma_s")))
    diagnostics.warning(
        p.location("sigma_s"),
        fmt::format("medium `{}` only absorbs light: scattering is not rendered", description.name));
  if (!is_finite(medium.sigma_a))
    diagnostics.error(p.location("scale"), "`scale` takes `sigma_a` beyond the range of floats");
  if (is_black(medium.sigma_a)) return kVacuum;
  if (media_.empty()) media_.emplace_back();  // the vacuum
  if (media_.size() > kMostMedia) {
    diagnostics.error(description.name_location, fmt::format("there are more than {} media", kMostMedia));
    return kVacuum;
  }
  media_.push_back(medium);
  return static_cast<MediumIndex>(media_.size() - 1);
}

MediumIndex MediumTable::resolve(const MediumReference& reference, DiagnosticList& diagnostics) {
  if (reference.name.empty()) return kVacuum;
  const auto found = by_name_.find(reference.name);
  if (found != by_name_.end()) return found->second;
  if (!reported_.insert(reference.name).second) return kVacuum;
  std::vector<std::string_view> names;
  for (const auto& [name, index] : by_name_) names.push_back(name);
  diagnostics.error(reference.location, fmt::format("no medium is named `{}`{}", reference.name,
                                                    name_hint(reference.name, names)));
  return kVacuum;
}

}  // namespace kaustik
