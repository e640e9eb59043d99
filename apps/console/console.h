#pragma once
// The program's output: results go to one stream, log and errors to another.

#include <ostream>
#include <string_view>

namespace kaustik::app {

struct Console {
  std::ostream& out;                     // results, such as the reports of compare and info
  std::ostream& err;                     // log, progress, warnings, errors
  bool terminal = false;                 // err is a terminal, so the progress bar may redraw its line
  bool quiet = false;                    // suppress log and progress, but not warnings and errors
  std::string_view command = "kaustik";  // prefix of warnings and errors

  // Writes one line to the log.
  void note(std::string_view line) const {
    if (!quiet) err << line << '\n';
  }
  void warning(std::string_view message) const { err << command << ": warning: " << message << '\n'; }
  void error(std::string_view message) const { err << command << ": " << message << '\n'; }
};

}  // namespace kaustik::app
