#pragma once
// The tables of docs/reference/command_line.md.

#include <string>

#include "apps/reference/option_text.h"

namespace kaustik::app {

// The page with each part between the lines "<!-- generated: NAME -->" and "<!-- end of NAME -->" replaced by
// what the program knows today; all else is left as it is. NAME: "commands", "exit-codes", "settings", or the
// name of a command for its usage and options. Throws std::runtime_error, which names the part, when one is
// unknown, is missing, occurs twice or has no end.
std::string updated_reference_page(const std::string& page, const Program& program);

}  // namespace kaustik::app
