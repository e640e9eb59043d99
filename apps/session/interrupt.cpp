#include "apps/session/interrupt.h"

#include <atomic>
#include <csignal>

namespace kaustik::app {

namespace {

// A signal handler may only access lock-free atomics, so the flag is global.
std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void remember(int signal) {
  interrupted = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  interrupted = false;
  previous_interrupt_ = std::signal(SIGINT, remember);
  previous_terminate_ = std::signal(SIGTERM, remember);
}

InterruptGuard::~InterruptGuard() {
  std::signal(SIGINT, previous_interrupt_);
  std::signal(SIGTERM, previous_terminate_);
}

bool InterruptGuard::requested() const {
  return interrupted;
}

render::ProgressCallback shown_in(ProgressBar& bar, const InterruptGuard& interrupt) {
  return [&bar, &interrupt](const render::Progress& progress) {
    bar.update(progress);
    return !interrupt.requested();
  };
}

}  // namespace kaustik::app
