#include "apps/settings/setting_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "apps/settings/list_options.h"

namespace kaustik::app {

void SettingOverrides::add(const Setting& setting, std::vector<std::string> texts) {
  const auto expected = static_cast<size_t>(setting.values);
  if (setting.kind != ValueKind::kNames && texts.size() != expected) {
    throw CLI::ValidationError(fmt::format("--{}", setting.name),
                               fmt::format("expected {} ({} value{}), got {}", setting.value_name, expected,
                                           expected == 1 ? "" : "s", texts.size()));
  }
  Settings scratch;
  if (const std::optional<std::string> complaint = setting.assign(scratch, texts)) {
    throw CLI::ValidationError(fmt::format("--{}", setting.name), *complaint);
  }
  given_.emplace_back(&setting, std::move(texts));
}

void SettingOverrides::append(const SettingOverrides& others) {
  given_.insert(given_.end(), others.given_.begin(), others.given_.end());
}

void SettingOverrides::apply(Settings& settings) const {
  if (sets("method")) {
    settings.render.direct.reset();
    settings.render.caustics.reset();
    settings.render.indirect.reset();
  }
  const auto assign = [&](bool presets) {
    for (const auto& [setting, texts] : given_)
      if ((setting->name == "quality") == presets) setting->assign(settings, texts);
  };
  assign(true);
  assign(false);
}

bool SettingOverrides::sets(std::string_view name) const {
  return std::any_of(given_.begin(), given_.end(), [&](const auto& g) { return g.first->name == name; });
}

Settings SettingOverrides::alone() const {
  Settings settings;
  apply(settings);
  return settings;
}

namespace {

std::string help_text(const Setting& setting) {
  const std::string unit = setting.unit.empty() ? std::string() : fmt::format(" [{}]", setting.unit);
  return fmt::format("{} Values{}: {}. Default: {}.", setting.doc, unit, setting.range, setting.default_text);
}

}  // namespace

void add_setting_options(CLI::App& parser, SettingOverrides& overrides, SettingsCommand command) {
  for (const Setting& setting : settings_table()) {
    if (!setting.commands.has(command)) continue;
    CLI::Option* option = parser.add_option_function<std::vector<std::string>>(
        fmt::format("--{}", setting.name),
        [&overrides, &setting](const std::vector<std::string>& texts) { overrides.add(setting, texts); },
        help_text(setting));
    option->option_text(std::string(setting.value_name))
        ->expected(setting.values)
        ->group(std::string(kSettingsGroup));
    if (!setting.choices.empty()) offer_choices(*option, setting.choices);
    option->multi_option_policy(setting.kind == ValueKind::kNames ? CLI::MultiOptionPolicy::TakeAll
                                                                  : CLI::MultiOptionPolicy::TakeLast);
  }
}

}  // namespace kaustik::app
