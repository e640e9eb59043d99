#pragma once
// How large a terminal is.

namespace kaustik::app {

struct TerminalSize {
  int columns = 80, rows = 24;
  int width = 0, height = 0;  // of the text area in pixels; 0: not known

  bool operator==(const TerminalSize&) const = default;
};

// The size now, which may change at any time. What the terminal does not tell keeps its default.
TerminalSize terminal_size(int file);

}  // namespace kaustik::app
