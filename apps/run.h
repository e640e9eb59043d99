#pragma once
// The program's entry as a function, so that the tests can call it in their own process.

#include <iosfwd>

namespace kaustik::app {

enum ExitCode {
  kDone = 0,
  kFailed = 1,          // while rendering or writing; `compare` above its limit
  kBadCommandLine = 2,  // nothing was started
  kBadScene = 3,        // the messages carry file:line:column
  kInterrupted = 130    // SIGINT or SIGTERM
};

// Runs one command line. Results go to `out`; progress, log and errors go to `err`. Throws nothing.
int run(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace kaustik::app
