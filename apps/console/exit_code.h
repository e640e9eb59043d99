#pragma once
// The exit codes of the program, which docs/reference/command_line.md documents.

namespace kaustik::app {

enum ExitCode {
  kDone = 0,
  kFailed = 1,          // failure while rendering or writing; `compare` above its limit
  kBadCommandLine = 2,  // found before any work was done
  kBadScene = 3,        // reported with file:line:column
  kInterrupted = 130    // by SIGINT, SIGTERM, SIGHUP or SIGXCPU
};

}  // namespace kaustik::app
