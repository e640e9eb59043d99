// The rows of settings that decide how scene files of other programs are read.

#include "apps/command_line/values.h"
#include "apps/settings/table/choice_row.h"

namespace kaustik::app {

namespace {

Setting light_unit_row() {
  const auto unit = [](auto& settings) -> auto& {
    return settings.import_options.light_unit;
  };
  return choice_row<LightUnit>(
      "light-unit", kImportingCommands, unit, kLightUnitNames,
      "What the numbers of a glTF file's lights mean. photometric: candela and lux, divided by 683 "
      "lm/W. watt: the power of point and spot lights and W/m^2 of directional ones, which old "
      "exporters wrote.");
}

// Seconds and frames set the same moment.
std::vector<std::string> shown_seconds(const Settings& settings) {
  const std::optional<float>& seconds = settings.import_options.seconds;
  return seconds ? as_texts(*seconds) : std::vector<std::string>{};
}

Setting at_row() {
  Setting s{.name = "at",
            .commands = kImportingCommands,
            .kind = ValueKind::kNumber,
            .value_name = "SECONDS",
            .unit = "s",
            .range = "0 or more",
            .default_text = "the beginning",
            .doc = "The moment at which an animated glTF file is shown."};
  s.assign = [](Settings& settings, ValueTexts texts) -> Complaint {
    const std::optional<float> seconds = parse_number(texts[0]);
    if (!seconds || *seconds < 0) return fmt::format("`{}`: expected a time in seconds, 0 or more", texts[0]);
    settings.import_options.seconds = *seconds;
    return std::nullopt;
  };
  s.show = shown_seconds;
  return s;
}

Setting frame_row() {
  Setting s{.name = "frame",
            .commands = kImportingCommands,
            .kind = ValueKind::kCount,
            .value_name = "N",
            .range = "0 or more",
            .default_text = "the beginning",
            .doc =
                "The same as --at N/24: glTF files have seconds in place of frames, and most come from films "
                "of 24 frames a second."};
  s.assign = [](Settings& settings, ValueTexts texts) -> Complaint {
    const std::optional<uint64_t> frame = parse_count(texts[0]);
    if (!frame) return fmt::format("`{}`: expected a whole number, 0 or more", texts[0]);
    settings.import_options.seconds = static_cast<float>(*frame) / kFramesPerSecond;
    return std::nullopt;
  };
  // The row `at` shows the moment.
  s.show = [](const Settings&) { return std::vector<std::string>{}; };
  return s;
}

}  // namespace

std::vector<Setting> import_rows() {
  std::vector<Setting> rows = {light_unit_row(), at_row(), frame_row()};
  for (Setting& row : rows) row.in_scene_files = false;
  return rows;
}

}  // namespace kaustik::app
