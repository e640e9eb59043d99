#pragma once
// A sweep as one HTML page that needs nothing else: no network, no other file.

#include <string>

#include "apps/sweep/sweep_result.h"

namespace kaustik::app {

// UTF-8. folder: where the pictures lie that the result names; they become data: URIs. Texts of the result,
// the scene's name among them, are escaped. Throws std::runtime_error when a picture cannot be read.
std::string sweep_report(const SweepResult& result, const std::string& folder);

}  // namespace kaustik::app
