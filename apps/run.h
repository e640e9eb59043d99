#pragma once
// The program's entry point as a function, so that tests can call it in their own process.

#include <iosfwd>

#include "apps/console/exit_code.h"

namespace kaustik::app {

// Runs one command line and returns an ExitCode. Results go to `out`; progress, log and errors go to `err`.
// Throws nothing.
int run(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace kaustik::app
