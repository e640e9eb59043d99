#pragma once
// Sends the picture in progress to a viewer that speaks the protocol of tev, from a thread of its own.
//
// The viewer may be slow, die, or not be there: that costs a warning and nothing else. There is never more
// than one message in memory, which holds the newest state at the time when the one before was sent, and at
// most kViewerShare of the processors is taken. A viewer that is lost is looked for until the end of the
// render, and then gets the whole picture again.

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "apps/live/live_render.h"
#include "apps/live/tcp_connection.h"

namespace kaustik::app {

// All light and the layers of light and features, and those of the names but the ones for denoisers. Throws
// std::invalid_argument as live_channels() does.
std::vector<LiveChannel> display_channels(std::vector<std::string> layers);

class TevDisplay : public LiveViewer {
 public:
  // The picture has the name of the render's title. `live` and `console` must outlive the display.
  TevDisplay(ServerAddress address, std::vector<LiveChannel> channels, LiveRender& live,
             const Console& console);
  // Sends the last state for a second at most. The picture stays in the viewer.
  ~TevDisplay() override;

 private:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;
  static constexpr std::chrono::milliseconds kBetweenUpdates{200};
  static constexpr std::chrono::milliseconds kBetweenAttempts{500};
  static constexpr std::chrono::seconds kAtEnd{1};

  void run();
  // Whether there is a viewer; tries to connect if there is none.
  bool has_viewer();
  // Sends what has changed since the last time. False if the viewer has not taken all of it: it is lost, or
  // the time at the end is over.
  bool send_changes();
  // sent: whether the viewer has the last state.
  void finish(bool sent);
  // Warns of it once until the viewer is back.
  void say_missing(std::string_view what, std::string_view outlook);
  void say_back();
  // Waits, but not beyond the end of the render.
  void rest(Seconds duration);
  bool ending() const;
  bool too_late() const;

  const ServerAddress address_;
  const std::vector<LiveChannel> channels_;
  LiveRender& live_;
  const Console& console_;

  // Of the thread alone.
  TcpConnection connection_;
  bool created_ = false;       // the viewer has the picture
  bool said_missing_ = false;  // people know that there is no viewer
  uint64_t version_ = 0;       // of the picture that the viewer has
  std::vector<float> values_;

  mutable std::mutex mutex_;  // guards the end
  std::condition_variable changed_;
  std::optional<Clock::time_point> end_;
  std::thread thread_;
};

}  // namespace kaustik::app
