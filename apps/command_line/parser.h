#pragma once
// Parses the arguments of the program.

#include <ostream>
#include <variant>

#include "apps/command_line/command.h"

namespace kaustik::app {

// Returns the command that was given, with its options assigned; or the exit code if there is nothing to run:
// after --help and --version, and for a bad command line, whose message goes to err.
std::variant<const Command*, ExitCode> parse_arguments(const Program& program, int argc,
                                                       const char* const* argv, std::ostream& out,
                                                       std::ostream& err);

}  // namespace kaustik::app
