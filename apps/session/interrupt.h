#pragma once
// Turns signals that ask the program to end into a flag that long work polls.

#include <array>
#include <csignal>

#include "apps/console/progress_bar.h"
#include "render/plan/progress.h"

namespace kaustik::app {

// While a guard exists, the first SIGINT, SIGTERM, SIGHUP or SIGXCPU sets the flag and a second one ends the
// process as usual, except SIGXCPU; signals that were ignored stay so. A pipe that loses its reader raises no
// SIGPIPE: if it was to read the messages, that counts as a signal. The destructor restores the previous
// handlers. Only one guard may exist at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  // Whether a signal has arrived or messages have lost their reader. Thread-safe.
  bool requested() const;

 private:
  using Handler = void (*)(int);
  static constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP, SIGXCPU};

  std::array<Handler, kSignals.size()> previous_{};
  Handler previous_pipe_;
};

// Shows progress in the bar, and cancels after a signal. Refers to both.
render::ProgressCallback shown_in(ProgressBar& bar, const InterruptGuard& interrupt);

}  // namespace kaustik::app
