#pragma once
// The one table of every render setting. From it come the options of `kaustik render`, the parameters of the
// scene file's Integrator "photonmap" line, and the reference in docs/cli.md.

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
  std::string range{};                      // what is accepted, in words
  std::string default_text{};               // what holds when nobody says anything
  std::string_view doc{};                   // one or two sentences
  int values = 1;                           // how many values it takes
  std::vector<std::string_view> choices{};  // of kChoice and kNames
  // Sets the field from the values' texts. Returns a complaint that begins with the text that was wrong and
  // says what was expected; then the settings are unchanged.
  std::function<std::optional<std::string>(Settings&, std::span<const std::string>)> assign{};
  // The other way: texts that assign the value which the settings have, exactly. None when it is unset.
  std::function<std::vector<std::string>(const Settings&)> show{};
  // Whether the sums over samples depend on it, not only which files are made of them and how fast.
  bool decides_sums = true;
};

// In the order of the help. Built once, immutable.
const std::vector<Setting>& settings_table();

// The setting of this name; dashes count for nothing, so that "conek" finds "cone-k". Null when there is
// none.
const Setting* find_setting(std::string_view name);

// The table as docs/cli.md shows it.
std::string settings_markdown();

}  // namespace kaustik::app
