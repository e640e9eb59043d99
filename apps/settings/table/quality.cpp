#include "apps/settings/table/quality.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "apps/command_line/values.h"
#include "core/diagnostics/nearest_name.h"

namespace kaustik::app {

namespace {

std::string described(const QualityPreset& preset) {
  std::string text =
      fmt::format("{}: {} photons, {} samples", preset.name, count_text(preset.photons), preset.spp);
  if (preset.passes > 1) text += fmt::format(" in {} passes", preset.passes);
  return text;
}

std::string explanation() {
  std::vector<std::string> presets;
  for (const QualityPreset& preset : kQualityPresets) presets.push_back(described(preset));
  return fmt::format(
      "Preset of --photons, --spp, --passes, --balance-photons (on) and --balance-samples (on). {}.",
      fmt::join(presets, "; "));
}

}  // namespace

Setting quality_setting() {
  static const std::string doc = explanation();
  Setting s{.name = "quality",
            .commands = SettingsCommand::kRender,
            .kind = ValueKind::kChoice,
            .value_name = "NAME",
            .default_text = "the defaults of these settings",
            .doc = doc};
  for (const QualityPreset& preset : kQualityPresets) s.choices.push_back(preset.name);
  s.range = fmt::format("{}", fmt::join(s.choices, ", "));
  s.assign = [names = s.choices](Settings& settings,
                                 std::span<const std::string> texts) -> std::optional<std::string> {
    const auto preset =
        std::find_if(kQualityPresets.begin(), kQualityPresets.end(),
                     [&](const QualityPreset& candidate) { return candidate.name == texts[0]; });
    if (preset == kQualityPresets.end())
      return fmt::format("`{}` is not a valid value{}", texts[0], name_hint(texts[0], names));
    settings.render.photons = preset->photons;
    settings.render.balance = render::Balance::kOn;
    settings.render.spp = preset->spp;
    settings.render.sample_balance = render::Balance::kOn;
    settings.render.passes = preset->passes;
    settings.render.final_gather = preset->unbiased ? std::optional(false) : std::nullopt;
    return std::nullopt;
  };
  // The settings that it changed are shown under their own names.
  s.show = [](const Settings&) { return std::vector<std::string>{}; };
  return s;
}

}  // namespace kaustik::app
