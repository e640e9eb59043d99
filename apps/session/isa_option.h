#pragma once
// The option --isa of the commands whose results depend on the instruction set.

#include "apps/command_line/command.h"

namespace kaustik::app {

// Takes effect when the command line is parsed.
void add_isa_option(Command& command);

}  // namespace kaustik::app
