#include "apps/live/live_render.h"

#include <chrono>
#include <utility>

namespace kaustik::app {

LiveStatus LiveRender::status() const {
  const std::lock_guard lock(mutex_);
  LiveStatus status = status_;
  if (status.state != LiveState::kFinished) status.seconds = since_.seconds();
  return status;
}

bool LiveRender::go_on(const std::function<bool()>& cancelled) {
  constexpr std::chrono::milliseconds kBetweenQuestions{50};
  std::unique_lock lock(mutex_);
  while (status_.state == LiveState::kPaused && !status_.stopped && !cancelled())
    changed_.wait_for(lock, kBetweenQuestions);
  return !status_.stopped && !cancelled();
}

void LiveRender::tell(const render::Progress& progress, double fraction, std::optional<double> seconds_left) {
  const std::lock_guard lock(mutex_);
  status_.phase = progress.phase;
  status_.pass = progress.pass, status_.passes = progress.passes;
  status_.fraction = fraction, status_.seconds_left = seconds_left;
}

void LiveRender::tell_error(uint64_t passes, double error) {
  const std::lock_guard lock(mutex_);
  std::vector<ErrorPoint>& errors = status_.errors;
  if (errors.size() == kMostErrors) {
    for (size_t i = 0; 2 * i < kMostErrors; ++i) errors[i] = errors[2 * i];
    errors.resize(kMostErrors / 2);
  }
  errors.push_back({since_.seconds(), passes, error});
}

void LiveRender::finish(std::string trouble) {
  const std::lock_guard lock(mutex_);
  status_.trouble = std::move(trouble);
  status_.seconds = since_.seconds();
  status_.state = LiveState::kFinished;
  status_.seconds_left = 0;
}

std::vector<LiveMessage> LiveRender::take_messages() {
  const std::lock_guard lock(mutex_);
  return std::exchange(messages_, {});
}

void LiveRender::say(LiveMessage message) {
  const std::lock_guard lock(mutex_);
  messages_.push_back(std::move(message));
}

void LiveRender::pause(bool paused) {
  const std::lock_guard lock(mutex_);
  if (status_.state == LiveState::kFinished) return;
  status_.state = paused ? LiveState::kPaused : LiveState::kRunning;
  changed_.notify_all();
}

void LiveRender::stop() {
  const std::lock_guard lock(mutex_);
  status_.stopped = true;
  changed_.notify_all();
}

void show_messages(const std::vector<LiveMessage>& messages, const Console& console) {
  for (const LiveMessage& message : messages) {
    if (message.warning)
      console.warning(message.text);
    else
      console.note(message.text);
  }
}

}  // namespace kaustik::app
