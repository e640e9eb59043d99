#pragma once
// Helpers and rows for the settings table.

#include <fmt/format.h>

#include "apps/settings/table/table.h"

namespace kaustik::app {

using Complaint = std::optional<std::string>;
using ValueTexts = std::span<const std::string>;

template <class... Values>
std::vector<std::string> as_texts(const Values&... values) {
  return {fmt::format("{}", values)...};
}

// The rows for stop rules and the bias estimate.
std::vector<Setting> stop_rows();

// Commands that read a scene file on the command line. Rows of the two functions below decide what the scene
// is, so a scene file cannot set them.
inline constexpr CommandSet kImportingCommands =
    kRenderingCommands | SettingsCommand::kPhotons | SettingsCommand::kInfo | SettingsCommand::kConvert;

// The rows that decide how scene files of other programs are read.
std::vector<Setting> import_rows();

// The rows that say from where a scene is seen, and by which light.
std::vector<Setting> view_rows();

}  // namespace kaustik::app
