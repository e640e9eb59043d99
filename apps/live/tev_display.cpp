#include "apps/live/tev_display.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "apps/live/tev_protocol.h"
#include "apps/live/viewer_pace.h"
#include "core/thread_time.h"
#include "render/film/media_sums.h"

namespace kaustik::app {

namespace {

// Those for denoisers, and those of media, which live pictures do not hold.
bool is_left_out(const LiveChannel& channel) {
  if (channel.layer < 0) return false;
  const render::LayerRow& row = render::kLayerTable[size_t(channel.layer)];
  return row.name.starts_with("denoising_") || is_of_media(row);
}

}  // namespace

std::vector<LiveChannel> display_channels(std::vector<std::string> layers) {
  for (const char* name : {"emitted", "direct", "caustic", "indirect", "albedo", "normal", "depth"})
    layers.emplace_back(name);
  std::vector<LiveChannel> channels = live_channels(layers);
  std::erase_if(channels, is_left_out);
  return channels;
}

TevDisplay::TevDisplay(ServerAddress address, std::vector<LiveChannel> channels, LiveRender& live,
                       const Console& console)
    : address_(std::move(address)), channels_(std::move(channels)), live_(live), console_(console) {
  try {
    thread_ = std::thread([this] {
      try {
        run();
      } catch (const std::exception& error) {
        live_.say({true, fmt::format("--display {}: {}; the picture is no longer shown", address_.text(),
                                     error.what())});
      }
    });
  } catch (const std::system_error& error) {
    live_.say({true, fmt::format("--display {}: the picture is not shown: {}", address_.text(),
                                 error.code().message())});
  }
}

TevDisplay::~TevDisplay() {
  {
    const std::lock_guard lock(mutex_);
    end_ = Clock::now() + kAtEnd;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
  show_messages(live_.take_messages(), console_);
}

bool TevDisplay::ending() const {
  const std::lock_guard lock(mutex_);
  return end_.has_value();
}

bool TevDisplay::too_late() const {
  const std::lock_guard lock(mutex_);
  return end_ && Clock::now() >= *end_;
}

void TevDisplay::rest(Seconds duration) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, duration, [&] { return end_.has_value(); });
}

void TevDisplay::run() {
  while (true) {
    const bool last = ending();  // what is read from now on is the last state
    const double before = thread_seconds();
    const bool sent = has_viewer() && send_changes();
    if (last || too_late()) return finish(last && sent);
    rest(sent ? std::max<Seconds>(kBetweenUpdates, Seconds(rest_after(thread_seconds() - before)))
              : kBetweenAttempts);
  }
}

bool TevDisplay::has_viewer() {
  if (connection_.check()) {
    say_back();
    return true;
  }
  if (created_) say_missing("lost the viewer", "it gets the whole picture when it is back");
  created_ = false, version_ = 0;
  // The end of the render is late enough for a first attempt, but no reason to wait for those who were never
  // there.
  const auto keep_waiting = [&] { return said_missing_ ? !ending() : !too_late(); };
  if (connection_.open(address_, keep_waiting)) return true;
  say_missing("no viewer", "it gets the picture when it is there");
  return false;
}

bool TevDisplay::send_changes() {
  const auto send = [&](const std::string& message) {
    return connection_.send(message, [&] { return !too_late(); });
  };
  const LivePicture& picture = live_.picture;
  if (!created_) {
    created_ = true;
    if (!send(tev_create(live_.title(), picture.full_width(), picture.full_height(), channels_)))
      return false;
  }
  const LivePicture::Changes changes = picture.changed_since(version_);
  for (const render::PixelRange& range : joined_tiles(changes.tiles, channels_.size())) {
    values_.resize(range.pixels() * channels_.size());
    picture.read(range, channels_, values_.data());
    if (!send(tev_update(live_.title(), range, channels_, values_))) return false;
  }
  version_ = changes.version;
  return true;
}

void TevDisplay::finish(bool sent) {
  if (sent) {
    if (connection_.check()) say_back();
  } else if (created_) {
    live_.say(
        {true, fmt::format("the viewer at {} did not take all of the finished picture: {}", address_.text(),
                           connection_.is_open() ? "it was too slow" : connection_.trouble())});
  }
}

void TevDisplay::say_missing(std::string_view what, std::string_view outlook) {
  if (!said_missing_)
    live_.say({true, fmt::format("{} at {}: {}; {}", what, address_.text(), connection_.trouble(), outlook)});
  said_missing_ = true;
}

void TevDisplay::say_back() {
  if (said_missing_) live_.say({false, fmt::format("the viewer at {} is there", address_.text())});
  said_missing_ = false;
}

}  // namespace kaustik::app
