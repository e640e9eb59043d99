#pragma once
// How a terminal can show pictures: by what it answers to questions.

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "apps/console/screen.h"

namespace kaustik::app {

struct TerminalAnswers {
  bool kitty = false;                   // it knows kitty's graphics protocol
  bool sixel = false;                   // it knows sixels
  int cell_width = 0, cell_height = 0;  // in pixels; 0: it does not tell
  bool complete = false;                // the answer to the last question is there

  bool operator==(const TerminalAnswers&) const = default;
};

// A question of kitty's protocol, which terminals ignore that do not know it; one for the size of cells; and
// last one that all terminals answer, for the primary device attributes.
std::string terminal_questions();

// Reads the answers from all that has come from the terminal, among which there may be keys.
TerminalAnswers read_answers(std::string_view text);

// Asks a terminal, once, and reads what it answers. While it listens, the terminal neither shows nor gathers
// what is typed; its settings are restored after that. A key that interrupts ends the listening and then has
// its usual effect.
class TerminalDialogue {
 public:
  using Time = std::chrono::milliseconds;

  // file: of the terminal, open to be read; -1: there is none.
  explicit TerminalDialogue(int file) : file_(file) {}

  // Returns what is answered in this time. A terminal that the shell has given to another job, or that takes
  // no bytes now, is not asked.
  const TerminalAnswers& ask(Screen& screen, Time patience);
  // If answers are missing, waits for them until so long after the question: who reads from the terminal next
  // must not take them for typed keys.
  void await_rest(Time since_question);

 private:
  using Clock = std::chrono::steady_clock;

  void listen(Clock::time_point end, const std::function<void()>& before);

  const int file_;
  std::optional<Clock::time_point> asked_;
  std::string text_;  // from the terminal
  TerminalAnswers answers_;
};

// The terminal on which the error stream writes, opened to be read; -1 if there is none.
int open_error_terminal();

}  // namespace kaustik::app
