#pragma once

#include <string>

namespace kaustik::app {

// Opens an address in the user's browser by xdg-open, which runs on by itself. False if there is no such
// program.
bool open_browser(const std::string& url);

}  // namespace kaustik::app
