#include "apps/settings/setting_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/files/read_root.h"

namespace kaustik::app {

void SettingOverrides::add(const Setting& setting, std::vector<std::string> texts) {
  const auto expected = static_cast<size_t>(setting.values);
  if (setting.kind != ValueKind::kNames && texts.size() != expected) {
    throw OptionError(fmt::format("--{}", setting.name),
                      fmt::format("expected {} ({} value{}), got {}", setting.value_name, expected,
                                  expected == 1 ? "" : "s", texts.size()));
  }
  Settings scratch;
  if (const std::optional<std::string> complaint = setting.assign(scratch, texts)) {
    throw OptionError(fmt::format("--{}", setting.name), *complaint);
  }
  given_.emplace_back(&setting, std::move(texts));
}

void SettingOverrides::append(const SettingOverrides& others) {
  std::erase_if(given_, [&](const auto& given) { return others.sets(given.first->name); });
  given_.insert(given_.end(), others.given_.begin(), others.given_.end());
  if (!others.root_.empty()) root_ = others.root_;
}

SettingOverrides SettingOverrides::of_machine() const {
  SettingOverrides out;
  out.root_ = root_;
  for (const auto& given : given_)
    if (given.first->name == "threads" || given.first->name == "memory") out.given_.push_back(given);
  return out;
}

void SettingOverrides::set_root(std::string folder) {
  try {
    const ReadRoot check(folder, {});
  } catch (const FileError& error) {
    throw OptionError("--root", fmt::format("cannot read the folder \"{}\": {}", folder, error.what()));
  }
  root_ = std::move(folder);
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
  if (sets("photons")) settings.render.balance = render::Balance::kOff;
  if (sets("spp")) settings.render.sample_balance = render::Balance::kOff;
  assign(false);
  if (!root_.empty()) settings.import_options.root = root_;
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

bool reads_scenes(SettingsCommand command) {
  return command != SettingsCommand::kMerge && command != SettingsCommand::kDenoise;
}

void add_root_option(Command& command, SettingOverrides& overrides) {
  command.add_parsed(
      "--root", "FOLDER",
      "For scenes of strangers: read the scene, and the files that it names, only if they lie in "
      "this folder, and write no file outside it that they name. Links that lead out are refused",
      [&overrides](const std::string& text) { overrides.set_root(text); });
}

}  // namespace

void add_setting_options(Command& command, SettingOverrides& overrides, SettingsCommand which) {
  if (reads_scenes(which)) add_root_option(command, overrides);
  for (const Setting& setting : settings_table()) {
    if (!setting.commands.has(which)) continue;
    Option option;
    option.names = {fmt::format("--{}", setting.name)};
    option.value_name = setting.value_name;
    option.description = help_text(setting);
    option.assign = [&overrides, &setting](const Texts& texts) { overrides.add(setting, texts); };
    option.values = setting.values;
    option.takes_list = setting.kind == ValueKind::kNames;
    option.last_wins = !option.takes_list;
    option.is_setting = true;
    option.for_everyday = setting.for_everyday;
    option.choices = choices_of(setting.choices);
    command.add_option(std::move(option));
  }
}

}  // namespace kaustik::app
