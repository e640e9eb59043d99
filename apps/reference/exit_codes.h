#pragma once
// What the exit codes mean, for the help, the reference page and the man page.

#include <array>
#include <string_view>

#include "apps/console/exit_code.h"

namespace kaustik::app {

struct ExitCodeRow {
  ExitCode code;
  std::string_view summary;  // a few words, for the help
  std::string_view meaning;  // sentences
};

inline constexpr std::array<ExitCodeRow, 5> kExitCodes = {
    {{kDone, "done", "The command did what it was asked to do."},
     {kFailed, "failure while rendering or above a limit",
      "Rendering or writing failed, or `compare` found an error above its limit."},
     {kBadCommandLine, "bad command line",
      "The command line is wrong: an unknown option, a bad value, an output that cannot be written, pictures "
      "that "
      "cannot be compared, or partial results that are damaged or do not belong together. Nothing was "
      "rendered."},
     {kBadScene, "bad scene",
      "The scene is wrong. Every error of its files is printed with file, line and column."},
     {kInterrupted, "interrupted",
      "SIGINT, SIGTERM, SIGHUP or SIGXCPU interrupted the command, or nobody reads its messages any more. "
      "`render` and `resume` write what is complete, `sweep` keeps its finished points, all other commands "
      "write nothing. A second signal, except SIGXCPU, ends the program at once."}}};

}  // namespace kaustik::app
