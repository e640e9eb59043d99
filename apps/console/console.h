#pragma once
// The program's output: results go to one stream, log and errors to another.

#include <memory>
#include <ostream>
#include <string>
#include <string_view>

#include "apps/console/screen.h"

namespace kaustik::app {

struct Console {
  std::ostream& out;                     // results, such as the reports of compare and info
  std::ostream& err;                     // log, progress, warnings, errors
  bool terminal = false;                 // err is a terminal, so the progress bar may redraw its line
  bool quiet = false;                    // suppress log and progress, but not warnings and errors
  std::string_view command = "kaustik";  // prefix of warnings and errors

  // Draws on err; null where it is no terminal.
  std::shared_ptr<Screen> screen = terminal ? screen_on(err) : nullptr;

  // Writes one line to the log. Thread-safe on a terminal.
  void note(std::string_view line) const {
    if (!quiet) log(std::string(line));
  }
  void warning(std::string_view message) const {
    log(std::string(command).append(": warning: ").append(message));
  }
  void error(std::string_view message) const { log(std::string(command).append(": ").append(message)); }

 private:
  void log(std::string line) const {
    line += '\n';
    screen ? screen->log(line) : void(err << line);
  }
};

}  // namespace kaustik::app
