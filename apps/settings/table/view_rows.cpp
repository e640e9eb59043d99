// The rows of settings that say from where a scene is seen, and by which light.

#include "apps/command_line/values.h"
#include "apps/settings/table/choice_row.h"

namespace kaustik::app {

namespace {

Setting camera_row() {
  Setting s{.name = "camera",
            .commands = kImportingCommands,
            .kind = ValueKind::kText,
            .value_name = "NAME",
            .range = "a camera's name, or its number from 1 on",
            .default_text = "the file's first",
            .doc = "Which of a file's cameras sees the scene."};
  s.assign = [](Settings& settings, ValueTexts texts) -> Complaint {
    if (texts[0].empty()) return "``: expected a camera's name or number";
    settings.import_options.view.camera = texts[0];
    return std::nullopt;
  };
  s.show = [](const Settings& settings) {
    const std::string& camera = settings.import_options.view.camera;
    return camera.empty() ? std::vector<std::string>{} : as_texts(camera);
  };
  return s;
}

Setting look_at_row() {
  Setting s{.name = "look-at",
            .commands = kImportingCommands,
            .kind = ValueKind::kNumber,
            .value_name = "EX EY EZ TX TY TZ UX UY UZ",
            .range = "three points or vectors: eye, target, up",
            .default_text = "the file's camera",
            .doc = "Place the camera: from the eye E towards the target T, with U up.",
            .values = 9};
  s.assign = [](Settings& settings, ValueTexts texts) -> Complaint {
    std::array<double, 9> values{};
    for (size_t i = 0; i < values.size(); ++i) {
      const std::optional<float> value = parse_number(texts[i]);
      if (!value) return fmt::format("`{}`: expected a number", texts[i]);
      values[i] = double(*value);
    }
    settings.import_options.view.look_at = values;
    return std::nullopt;
  };
  s.show = [](const Settings& settings) {
    std::vector<std::string> texts;
    if (const auto& look_at = settings.import_options.view.look_at)
      for (const double value : *look_at) texts.push_back(fmt::format("{}", static_cast<float>(value)));
    return texts;
  };
  return s;
}

Setting fov_row() {
  Setting s{.name = "fov",
            .commands = kImportingCommands,
            .kind = ValueKind::kNumber,
            .value_name = "ANGLE",
            .unit = "degrees",
            .range = "between 0 and 180",
            .default_text = "the camera's",
            .doc = "Field of view of a perspective camera along the picture's shorter side."};
  s.assign = [](Settings& settings, ValueTexts texts) -> Complaint {
    const std::optional<float> value = parse_number(texts[0]);
    if (!value || !(*value > 0 && *value < 180))
      return fmt::format("`{}`: expected an angle between 0 and 180 degrees", texts[0]);
    settings.import_options.view.fov = double(*value);
    return std::nullopt;
  };
  s.show = [](const Settings& settings) -> std::vector<std::string> {
    const auto& fov = settings.import_options.view.fov;
    return fov ? as_texts(static_cast<float>(*fov)) : std::vector<std::string>{};
  };
  return s;
}

Setting sky_row() {
  Setting s{
      .name = "sky",
      .commands = kImportingCommands,
      .kind = ValueKind::kText,
      .value_name = "SKY",
      .range =
          "an image of all directions, a radiance like 0.5 or 0.2,0.4,1, a colour like #80a0ff or white, "
          "or off",
      .default_text = "the file's",
      .doc =
          "Light from all around in place of the file's own. An image is 2:1 or a square equal-area "
          "map, with +y up. off: none, not even the stand-in for a file without light."};
  s.assign = [](Settings& settings, ValueTexts texts) -> Complaint {
    const std::string& text = texts[0];
    if (text != "off" && !parse_colour(text) && text.find('.') == text.npos)
      return fmt::format(
          "`{}`: expected an image file, a colour such as 0.5, 0.2,0.4,1, #80a0ff or white, or "
          "off",
          text);
    settings.import_options.view.sky = text;
    return std::nullopt;
  };
  s.show = [](const Settings& settings) {
    const std::string& sky = settings.import_options.view.sky;
    return sky.empty() ? std::vector<std::string>{} : as_texts(sky);
  };
  return s;
}

Setting floor_row() {
  const auto floor = [](auto& settings) -> auto& {
    return settings.import_options.view.floor;
  };
  return choice_row<Floor>(
      "floor", kImportingCommands, floor, kFloorNames,
      "A floor just below the model of a glTF or OBJ file, which takes its shadow and its "
      "caustics. auto: on for a model that has neither camera nor light.");
}

}  // namespace

std::vector<Setting> view_rows() {
  std::vector<Setting> rows = {camera_row(), look_at_row(), fov_row(), sky_row(), floor_row()};
  for (Setting& row : rows) row.in_scene_files = false;
  return rows;
}

}  // namespace kaustik::app
