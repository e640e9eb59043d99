#pragma once
// Adds rows of the settings table as options to a subcommand.

#include <span>
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

// Adds an option --name for each setting of the table, or only for those in `names` if it is not empty.
// `overrides` must outlive `command`.
void add_setting_options(CLI::App& command, SettingOverrides& overrides,
                         std::span<const std::string_view> names = {});

}  // namespace kaustik::app
