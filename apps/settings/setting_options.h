#pragma once
// Adds rows of the settings table as options to a subcommand.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/settings/table.h"

namespace CLI {
class App;
}

namespace kaustik::app {

// The settings given on the command line, in their order. They are applied over the scene file's settings.
class SettingOverrides {
 public:
  // Adds a setting. Throws CLI::ValidationError when the values are invalid.
  void add(const Setting& setting, std::vector<std::string> texts);
  // Appends all settings of `others`.
  void append(const SettingOverrides& others);
  // Applies the settings. --method also resets the three estimators that the scene file chose. --quality
  // replaces the scene file's photons, samples and passes, but not values for them that the command line
  // gives itself.
  void apply(Settings& settings) const;
  bool sets(std::string_view name) const;
  // The default settings with only the command line applied.
  Settings alone() const;

 private:
  std::vector<std::pair<const Setting*, std::vector<std::string>>> given_;
};

// The heading of these options in the help.
inline constexpr std::string_view kSettingsGroup = "Settings";

// Adds --name for each setting of the table that names `command`. overrides must outlive parser.
void add_setting_options(CLI::App& parser, SettingOverrides& overrides, SettingsCommand command);

}  // namespace kaustik::app
