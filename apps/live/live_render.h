#pragma once
// A render in progress as those see it who follow it, and what they may ask of it. All functions are
// thread-safe.

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "apps/console/console.h"
#include "apps/live/live_picture.h"
#include "core/stopwatch.h"
#include "render/plan/progress.h"

namespace kaustik::app {

// A line for the person at the console.
struct LiveMessage {
  bool warning = false;  // else a note of the log
  std::string text;
};

enum class LiveState { kRunning, kPaused, kFinished };

// The estimated relative error after a pass.
struct ErrorPoint {
  double seconds = 0;
  uint64_t passes = 0;
  double error = 0;
};

struct LiveStatus {
  LiveState state = LiveState::kRunning;
  std::string phase;  // "trials", "photons", "build", "render"; empty before the first one
  uint64_t pass = 0, passes = 0;
  double fraction = 0;                 // done of the whole render, 0 to 1
  std::optional<double> seconds_left;  // until the end of the render
  double seconds = 0;                  // since the render began
  std::vector<ErrorPoint> errors;      // of the passes so far
  bool stopped = false;                // a follower has asked for the end
  std::string trouble{};               // why there is no picture, or no more of it
};

class LiveRender {
 public:
  // title: of the picture, for people.
  LiveRender(std::string title, const render::PixelRange& range, int full_width, int full_height)
      : picture(range, full_width, full_height), title_(std::move(title)) {}

  LivePicture picture;

  const std::string& title() const { return title_; }
  LiveStatus status() const;

  // For the render. go_on() waits while a follower holds the render, but not longer than `cancelled` is
  // false, and returns false when the render shall end with what it has.
  bool go_on(const std::function<bool()>& cancelled);
  void tell(const render::Progress& progress, double fraction, std::optional<double> seconds_left);
  void tell_error(uint64_t passes, double error);
  // trouble: what went wrong, if something did.
  void finish(std::string trouble = {});
  // What followers have said since the last call.
  std::vector<LiveMessage> take_messages();

  // For those who follow. stop(): the render ends and keeps what it has.
  void pause(bool paused);
  void stop();
  // Followers have threads of their own, and the console only takes lines from the render.
  void say(LiveMessage message);

 private:
  static constexpr size_t kMostErrors = 400;  // as many as a curve needs; those between are left out

  const std::string title_;
  const Stopwatch since_;
  mutable std::mutex mutex_;  // guards all that follows
  std::condition_variable changed_;
  LiveStatus status_;
  std::vector<LiveMessage> messages_;
};

void show_messages(const std::vector<LiveMessage>& messages, const Console& console);

// Shows a LiveRender somewhere, by a thread of its own. The destructor shows the last state and ends.
class LiveViewer {
 public:
  virtual ~LiveViewer() = default;
};

}  // namespace kaustik::app
