#pragma once
// Adds rows of the settings table as options to a subcommand.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/command_line/command.h"
#include "apps/settings/table/table.h"

namespace kaustik::app {

// The settings given on the command line, in their order. They are applied over the scene file's settings.
class SettingOverrides {
 public:
  // Adds a setting. Throws OptionError when the values are invalid.
  void add(const Setting& setting, std::vector<std::string> texts);
  // Appends all settings of `others`, and takes their root if they have one. Their values replace those of
  // the same settings here, so that a page that gives settings for days does not make the list longer.
  void append(const SettingOverrides& others);
  // Those that are for this process alone, which no manifest holds: --threads, --memory, --root.
  SettingOverrides of_machine() const;
  // Applies the settings. --method also resets the three estimators that the scene file chose. --quality
  // replaces the scene file's photons, samples and passes, but not values for them that the command line
  // gives itself.
  void apply(Settings& settings) const;
  bool sets(std::string_view name) const;
  // The number of values that are given, counting each time that a setting is given.
  size_t size() const { return given_.size(); }
  // The value of --root; empty if it is not given.
  const std::string& root() const { return root_; }
  // Throws OptionError if there is no such folder.
  void set_root(std::string folder);
  // The default settings with only the command line applied.
  Settings alone() const;

 private:
  std::vector<std::pair<const Setting*, std::vector<std::string>>> given_;
  std::string root_;
};

// Adds --name for each setting of the table that `which` takes, and --root if the command reads scenes.
// overrides must outlive the parsing.
void add_setting_options(Command& command, SettingOverrides& overrides, SettingsCommand which);

}  // namespace kaustik::app
