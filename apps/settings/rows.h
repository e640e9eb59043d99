#pragma once
// Helpers and rows for the settings table.

#include <fmt/format.h>

#include "apps/settings/table.h"

namespace kaustik::app {

using Complaint = std::optional<std::string>;
using ValueTexts = std::span<const std::string>;

template <class... Values>
std::vector<std::string> as_texts(const Values&... values) {
  return {fmt::format("{}", values)...};
}

// The rows for stop rules and the bias estimate.
std::vector<Setting> stop_rows();

// The rows that decide how scene files of other programs are read.
std::vector<Setting> import_rows();

}  // namespace kaustik::app
