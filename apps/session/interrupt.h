#pragma once
// SIGINT and SIGTERM as a question that long work asks now and then.

namespace kaustik::app {

// While one lives, the first signal is remembered and a second one ends the process as usual. Restores the
// previous handlers. One at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  // Whether a signal has come. From any thread.
  bool requested() const;

 private:
  void (*previous_interrupt_)(int);
  void (*previous_terminate_)(int);
};

}  // namespace kaustik::app
