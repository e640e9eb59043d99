#pragma once

#include "apps/command_line/command.h"
#include "apps/web/page_server.h"

namespace kaustik::app {

// Adds --port, --listen, --reference and --open. needs: an option without which they mean nothing; empty for
// none.
void add_page_options(Command& command, PageOptions& options, const std::string& needs = {});

}  // namespace kaustik::app
