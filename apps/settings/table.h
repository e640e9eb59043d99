#pragma once
// The table of all render settings. It defines the options of `kaustik render`, the parameters of Integrator
// "photonmap" in scene files, and the reference in docs/cli.md.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/settings/settings.h"

namespace kaustik::app {

enum class ValueKind { kCount, kInteger, kNumber, kChoice, kNames };

struct Setting {
  std::string_view name{};  // as on the command line, without the leading dashes: "cone-k"
  ValueKind kind = ValueKind::kChoice;
  std::string_view value_name{};            // placeholder in the help: "COUNT"
  std::string_view unit{};                  // "m", "pixels"; empty for choices and pure numbers
  std::string range{};                      // accepted values, in words
  std::string default_text{};               // the default, in words
  std::string_view doc{};                   // one or two sentences for the help
  int values = 1;                           // number of values that it takes
  std::vector<std::string_view> choices{};  // accepted names, for kChoice and kNames
  // Sets the field from the texts of its values. For invalid texts it leaves the settings unchanged and
  // returns an error message that begins with the text and says what was expected.
  std::function<std::optional<std::string>(Settings&, std::span<const std::string>)> assign{};
  // The inverse of `assign`: texts that set exactly the current value; empty when the field is unset.
  std::function<std::vector<std::string>(const Settings&)> show{};
  // Whether the setting affects the sums over samples, and not only the files written from them or the speed.
  bool decides_sums = true;
};

// All settings in the order of the help. Built once, immutable.
const std::vector<Setting>& settings_table();

// The setting of this name, ignoring dashes, so that "conek" finds "cone-k"; null when there is none.
const Setting* find_setting(std::string_view name);

// The table in Markdown, as docs/cli.md shows it.
std::string settings_markdown();

}  // namespace kaustik::app
