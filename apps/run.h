#pragma once
// The program's entry point as a function, so that tests can call it in their own process.

#include <iosfwd>

namespace kaustik::app {

enum ExitCode {
  kDone = 0,
  kFailed = 1,          // failure while rendering or writing; `compare` above its limit
  kBadCommandLine = 2,  // found before any work was done
  kBadScene = 3,        // reported with file:line:column
  kInterrupted = 130    // by SIGINT or SIGTERM
};

// Runs one command line. Results go to `out`; progress, log and errors go to `err`. Throws nothing.
int run(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace kaustik::app
