// The rows of settings that decide how scene files of other programs are read.

#include <fmt/ranges.h>

#include "apps/settings/rows.h"
#include "core/diagnostics/nearest_name.h"
#include "render/settings/names.h"

namespace kaustik::app {

namespace {

constexpr CommandSet kCommandsThatImport =
    kRenderingCommands | SettingsCommand::kPhotons | SettingsCommand::kInfo | SettingsCommand::kConvert;

Setting light_unit_row() {
  Setting s{.name = "light-unit",
            .commands = kCommandsThatImport,
            .kind = ValueKind::kChoice,
            .value_name = "NAME",
            .range = fmt::format("{}", fmt::join(kLightUnitNames, ", ")),
            .default_text = std::string(kLightUnitNames[0]),
            .doc =
                "What the numbers of a glTF file's lights mean. photometric: candela and lux, divided by 683 "
                "lm/W. watt: the power of point and spot lights and W/m^2 of directional ones, which old "
                "exporters wrote."};
  s.choices.assign(kLightUnitNames.begin(), kLightUnitNames.end());
  s.assign = [](Settings& settings, ValueTexts texts) -> Complaint {
    const auto unit = render::from_name<LightUnit>(kLightUnitNames, texts[0]);
    if (!unit)
      return fmt::format("`{}` is not a valid value{}", texts[0], name_hint(texts[0], kLightUnitNames));
    settings.import_options.light_unit = *unit;
    return std::nullopt;
  };
  s.show = [](const Settings& settings) {
    return as_texts(kLightUnitNames[static_cast<size_t>(settings.import_options.light_unit)]);
  };
  return s;
}

}  // namespace

std::vector<Setting> import_rows() {
  return {light_unit_row()};
}

}  // namespace kaustik::app
