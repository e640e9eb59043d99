#include "apps/session/interrupt.h"

#include <poll.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <iostream>

namespace kaustik::app {

namespace {

// A signal handler may only access lock-free atomics, so the flag is global.
std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void remember(int signal) {
  interrupted = true;
  // The limit of processor time (`ulimit -S -t`) is signalled every second until the hard limit kills.
  if (signal != SIGXCPU) std::signal(signal, SIG_DFL);
}

// Whether messages have been written to a pipe that nobody reads any more.
bool messages_are_lost() {
  if (std::cerr.good()) return false;
  pollfd error{STDERR_FILENO, 0, 0};
  return ::poll(&error, 1, 0) > 0 && (error.revents & POLLERR) != 0;
}

}  // namespace

InterruptGuard::InterruptGuard() {
  interrupted = false;
  for (size_t i = 0; i < kSignals.size(); ++i) {
    previous_[i] = std::signal(kSignals[i], remember);
    // `nohup` and shells that start a job in the background have it ignored.
    if (previous_[i] == SIG_IGN) std::signal(kSignals[i], SIG_IGN);
  }
  previous_pipe_ = std::signal(SIGPIPE, SIG_IGN);
}

InterruptGuard::~InterruptGuard() {
  for (size_t i = 0; i < kSignals.size(); ++i) std::signal(kSignals[i], previous_[i]);
  std::signal(SIGPIPE, previous_pipe_);
}

bool InterruptGuard::requested() const {
  return interrupted || messages_are_lost();
}

render::ProgressCallback shown_in(ProgressBar& bar, const InterruptGuard& interrupt) {
  return [&bar, &interrupt](const render::Progress& progress) {
    bar.update(progress);
    return !interrupt.requested();
  };
}

}  // namespace kaustik::app
