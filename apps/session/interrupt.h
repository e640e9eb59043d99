#pragma once
// Turns SIGINT and SIGTERM into a flag that long work polls.

#include "apps/console/progress_bar.h"
#include "render/plan/progress.h"

namespace kaustik::app {

// While a guard exists, the first signal sets the flag and a second one ends the process as usual. The
// destructor restores the previous handlers. Only one guard may exist at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  // Whether a signal has arrived. Thread-safe.
  bool requested() const;

 private:
  void (*previous_interrupt_)(int);
  void (*previous_terminate_)(int);
};

// Shows progress in the bar, and cancels after a signal. Refers to both.
render::ProgressCallback shown_in(ProgressBar& bar, const InterruptGuard& interrupt);

}  // namespace kaustik::app
