#pragma once
// Where the program speaks: results on one stream, log and errors on the other.

#include <ostream>
#include <string_view>

namespace kaustik::app {

struct Console {
  std::ostream& out;                     // results: reports of compare and info
  std::ostream& err;                     // log, progress, warnings, errors
  bool terminal = false;                 // err is one: the progress bar may redraw its line
  bool quiet = false;                    // no log and no progress; warnings and errors still come
  std::string_view command = "kaustik";  // begins error messages

  // One line of log.
  void note(std::string_view line) const {
    if (!quiet) err << line << '\n';
  }
  void warning(std::string_view message) const { err << command << ": warning: " << message << '\n'; }
  void error(std::string_view message) const { err << command << ": " << message << '\n'; }
};

}  // namespace kaustik::app
