#pragma once
// The manual page kaustik(1), in the man macros that groff and mandoc both read.

#include <string>

#include "apps/reference/option_text.h"

namespace kaustik::app {

std::string man_page(const Program& program);

}  // namespace kaustik::app
