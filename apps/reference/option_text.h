#pragma once
// How commands and options are written in the reference page, the man page and the completions.

#include <string>

#include "apps/command_line/command.h"

namespace kaustik::app {

// "kaustik merge PARTS... [OPTIONS]"
std::string usage(const Command& command);

// "-o FILE, --output FILE"; code: each name in backquotes.
std::string option_heading(const Option& option, bool code = false);

// A description up to the end of its first sentence, without the full stop.
std::string first_sentence(const std::string& description);

// The commands that the help shows.
std::vector<Command> visible_commands(const Program& program);

}  // namespace kaustik::app
