#include "apps/settings/settings_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/command_line/values.h"

namespace kaustik::app {

namespace {

using Json = nlohmann::ordered_json;

// A JSON number where the text is one and the setting holds numbers, else the text.
Json value_json(const Setting& setting, const std::string& text) {
  if (setting.kind == ValueKind::kChoice || setting.kind == ValueKind::kNames ||
      setting.kind == ValueKind::kText)
    return text;
  if (setting.kind == ValueKind::kCount) return parse_count(text).value();
  if (setting.kind == ValueKind::kInteger) return parse_integer(text).value();
  if (!parse_number(text)) return text;
  return std::stod(text);
}

std::string json_name(std::string_view name) {
  std::string out(name);
  std::replace(out.begin(), out.end(), '-', '_');
  return out;
}

}  // namespace

Json settings_json(const Settings& settings, const render::EstimatorPlan& plan,
                   const std::function<bool(const Setting&)>& listed) {
  Settings settled = settings;
  settled.render.direct = plan.direct;
  settled.render.caustics = plan.caustics;
  settled.render.indirect = plan.indirect;
  Json out = Json::object();
  for (const Setting& setting : settings_table()) {
    const std::vector<std::string> texts = setting.show(settled);
    if (!listed(setting) || texts.empty()) continue;
    Json value = Json::array();
    for (const std::string& text : texts) value.push_back(value_json(setting, text));
    const bool several = setting.values > 1 || setting.kind == ValueKind::kNames;
    out[json_name(setting.name)] = several ? value : value.front();
  }
  return out;
}

Json statistics_settings(const Settings& settings, const render::EstimatorPlan& plan) {
  return settings_json(settings, plan, [](const Setting& setting) {
    return setting.decides_sums && setting.name != "passes";
  });
}

}  // namespace kaustik::app
