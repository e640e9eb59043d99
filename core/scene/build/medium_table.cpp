// Makes media from their directives, and finds them by name.

#include "core/scene/build/medium_table.h"

#include <fmt/format.h>

#include "core/diagnostics/nearest_name.h"
#include "core/medium/phase_function.h"
#include "core/medium/preset_media.h"
#include "core/scene/build/medium_grid.h"

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

namespace {

// The coefficients of the preset, or those that are given.
Medium coefficients(const ParameterReader& p, DiagnosticList& diagnostics) {
  const auto g = std::clamp(static_cast<float>(p.number("g")), -kLargestG, kLargestG);
  if (!p.has("preset")) return {p.rgb("sigma_a"), p.rgb("sigma_s"), g};
  std::vector<std::string_view> names;
  for (const PresetMedium& m : preset_media()) {
    if (m.name == p.text("preset")) return {m.sigma_a, m.sigma_s, g};
    names.push_back(m.name);
  }
  diagnostics.error(p.location("preset"), fmt::format("there is no measured medium `{}`{}", p.text("preset"),
                                                      name_hint(p.text("preset"), names)));
  return {};
}

}  // namespace

MediumIndex MediumTable::make(const MediumDescription& description, WarnedOnce& warned,
                              DiagnosticList& diagnostics) {
  const TypeSpec* spec = find_type(category("MakeNamedMedium"), description, diagnostics);
  if (!spec || !check_parameters("medium", *spec, description, warned, diagnostics)) return kVacuum;
  const ParameterReader p(description, *spec);
  const auto scale = static_cast<float>(p.number("scale"));
  Medium medium = coefficients(p, diagnostics);
  medium.sigma_a *= scale;
  medium.sigma_s *= scale;
  if (!is_finite(medium.sigma_t()))
    diagnostics.error(p.location("scale"), "`scale` takes coefficients beyond the range of floats");
  const bool grid = spec->name == "uniformgrid";
  medium.Le = p.rgb("Le") * (grid ? 1.0f : static_cast<float>(p.number("Lescale")));
  if (!is_finite(medium.Le))
    diagnostics.error(p.location("Lescale"), "`Lescale` takes `Le` beyond the range of floats");
  if (grid && !check_grid(p, description, medium.sigma_t(), diagnostics)) return kVacuum;
  if (is_black(medium.sigma_t())) return kVacuum;
  if (media_.empty()) media_.emplace_back(), names_.emplace_back("vacuum");
  if (media_.size() > kMostMedia) {
    diagnostics.error(description.name_location, fmt::format("there are more than {} media", kMostMedia));
    return kVacuum;
  }
  media_.push_back(medium);
  names_.push_back(description.name);
  const auto index = static_cast<MediumIndex>(media_.size() - 1);
  if (grid) grids_.emplace_back(index, &description);
  return index;
}

std::vector<Medium> MediumTable::finish(const glm::dvec3& origin) {
  for (const auto& [index, description] : grids_)
    media_[index].density = std::make_shared<const DensityGrid>(make_grid(*description, origin));
  return std::move(media_);
}

MediumIndex MediumTable::resolve(const MediumReference& reference, DiagnosticList& diagnostics) {
  if (reference.name.empty()) return kVacuum;
  const auto found = by_name_.find(reference.name);
  if (found != by_name_.end()) return found->second;
  if (!reported_.insert(reference.name).second) return kVacuum;
  const auto names = [&] { return keys_of(by_name_); };
  diagnostics.error(reference.location, fmt::format("no medium is named `{}`{}", reference.name,
                                                    diagnostics.hint(reference.name, names)));
  return kVacuum;
}

}  // namespace kaustik
