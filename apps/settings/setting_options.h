#pragma once
// Rows of the settings table as options of a subcommand.

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

// What the command line sets, in the order in which it was given: applied over the scene file's settings.
class SettingOverrides {
 public:
  // Throws CLI::ValidationError when the values are bad.
  void add(const Setting& setting, std::vector<std::string> texts);
  // All of others, after what is there.
  void append(const SettingOverrides& others);
  // --method drops estimators that the scene file chose: it is the command line's word on all three.
  // --quality replaces what the scene file says of photons, samples, passes and radius, and yields to the
  // command line's own word on them.
  void apply(Settings& settings) const;
  bool sets(std::string_view name) const;
  // The settings with nothing but the command line.
  Settings alone() const;

 private:
  std::vector<std::pair<const Setting*, std::vector<std::string>>> given_;
};

// Adds --name for each setting of the table, or for those of `names` only. overrides must outlive command.
void add_setting_options(CLI::App& command, SettingOverrides& overrides,
                         std::span<const std::string_view> names = {});

}  // namespace kaustik::app
