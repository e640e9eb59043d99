#pragma once
// Writes the result of a sweep as one self-contained HTML page, which needs no network and no other file.

#include <string>

#include "apps/sweep/sweep_result.h"

namespace kaustik::app {

// The page in UTF-8. `folder` holds the pictures that the result names; they are embedded as data: URIs. All
// texts of the result, including the scene's name, are escaped. Throws std::runtime_error when a picture
// cannot be read.
std::string sweep_report(const SweepResult& result, const std::string& folder);

}  // namespace kaustik::app
