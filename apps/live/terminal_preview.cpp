#include "apps/live/terminal_preview.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <system_error>

#include "apps/live/preview_pixels.h"
#include "apps/live/terminal/half_blocks.h"
#include "apps/live/terminal/kitty.h"
#include "apps/live/terminal/sixel.h"
#include "apps/live/viewer_pace.h"
#include "core/stopwatch.h"
#include "core/thread_time.h"

namespace kaustik::app {

namespace {

using Seconds = std::chrono::duration<double>;

// How long answers may take: what is not answered by then is taken as a no. All common terminals answer, so
// this is long enough for slow lines and busy machines. The render does not wait, only the first picture
// does; and the program's end, since the answers must not reach whoever reads from the terminal next.
constexpr std::chrono::milliseconds kPatience{1500};

constexpr double kBetweenCells = 0.2, kBetweenPictures = 0.5;  // least time between redraws, in seconds
constexpr double kBytesPerSecond = 10e6, kBytesPerSecondBySsh = 500e3;
// The terminal's line is also for others: the least ratio of the time between redraws to that until one is
// written.
constexpr double kWriteRatio = 3;

bool is_set(const char* variable) {
  const char* const value = std::getenv(variable);
  return value && *value;
}

// Draws pictures one after another in one place of a screen.
class Painter {
 public:
  Painter(PictureWay way, const TerminalAnswers& answers, Screen& screen, int terminal)
      : way_(way), answers_(answers), screen_(screen), terminal_(terminal) {}

  // Redraws what the terminal does not show, or all of it anew. changed: the pixels have changed. Returns the
  // number of bytes.
  size_t paint(const PreviewPixels& pixels, const LivePicture& live, bool changed, bool anew) {
    const TerminalSize size = terminal_size(terminal_);
    const CellSize cell = cell_size(size, answers_.cell_width, answers_.cell_height);
    const PicturePlace place = picture_place(live.range().width(), live.range().height(), way_, size, cell);
    stale_ |= changed || place != place_;
    place_ = place;
    if (place.rows == 0) return 0;
    const std::string forget = way_ == PictureWay::kKitty ? kitty_removal(id_) : "";
    const auto bytes = [&](bool all) -> std::string {
      if (!stale_ && !all) return {};
      stale_ = false;
      return bytes_of(pixels.shown(place.width, place.height), all, cell);
    };
    return screen_.draw({place.rows, place.columns}, forget, bytes, anew);
  }

 private:
  std::string bytes_of(const Pixels8& pixels, bool all, const CellSize& cell) {
    switch (way_) {
      case PictureWay::kKitty:
        return kitty_picture(pixels,
                             cell.known ? KittyPlace{id_} : KittyPlace{id_, place_.columns, place_.rows});
      case PictureWay::kSixel:
        return sixel_picture(pixels);
      case PictureWay::kHalfBlocks:
        break;
    }
    if (all) lines_.clear();
    std::vector<std::string> lines = half_block_lines(pixels);
    std::string bytes = draw_lines(lines, lines_);
    lines_ = std::move(lines);
    return bytes;
  }

  // Pictures of earlier runs, which are still to be seen, have other numbers.
  const uint32_t id_ = uint32_t(getpid());
  const PictureWay way_;
  const TerminalAnswers answers_;
  Screen& screen_;
  const int terminal_;
  PicturePlace place_;
  bool stale_ = false;              // the screen does not show the last pixels
  std::vector<std::string> lines_;  // that the screen shows
};

// Nothing if there is no way.
std::optional<PictureWay> way_of(const TerminalAnswers& answers) {
  if (answers.kitty) return PictureWay::kKitty;
  if (answers.sixel) return PictureWay::kSixel;
  if (is_set("NO_COLOR")) return {};
  return PictureWay::kHalfBlocks;
}

// Measures a redraw, and how long to wait after it.
class Pace {
 public:
  explicit Pace(PictureWay way)
      : between_(way == PictureWay::kHalfBlocks ? kBetweenCells : kBetweenPictures),
        bytes_per_second_(is_set("SSH_CONNECTION") ? kBytesPerSecondBySsh : kBytesPerSecond) {}

  void start() { watch_ = Stopwatch(), processor_ = thread_seconds(); }
  Seconds pause_after(size_t bytes) const {
    return Seconds(std::max({between_, double(bytes) / bytes_per_second_, kWriteRatio * watch_.seconds(),
                             rest_after(thread_seconds() - processor_)}));
  }

 private:
  const double between_, bytes_per_second_;
  Stopwatch watch_;
  double processor_ = 0;
};

}  // namespace

TerminalPreview::TerminalPreview(LiveRender& live, const ToneChoice& tone, const Console& console,
                                 int terminal)
    : live_(live), console_(console), terminal_(terminal), thread_([this, tone] { run(tone); }) {}

TerminalPreview::~TerminalPreview() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  stop_.notify_all();
  thread_.join();
  if (terminal_ >= 0) close(terminal_);
}

bool TerminalPreview::stopped_after(Seconds time) {
  std::unique_lock lock(mutex_);
  return stop_.wait_for(lock, time, [&] { return stopping_; });
}

void TerminalPreview::run(const ToneChoice& tone) {
  TerminalDialogue dialogue(terminal_);
  try {
    const TerminalAnswers answers = dialogue.ask(*console_.screen, kPatience);
    if (const std::optional<PictureWay> way = way_of(answers))
      show(*way, answers, tone);
    else
      console_.warning(
          "--preview shows nothing: the terminal has no pictures, and NO_COLOR forbids coloured characters");
  } catch (const std::exception& error) {
    console_.warning(fmt::format("--preview shows no more: {}", error.what()));
  }
  dialogue.await_rest(kPatience);
}

void TerminalPreview::show(PictureWay way, const TerminalAnswers& answers, const ToneChoice& tone) {
  PreviewPixels pixels(live_.picture, tone);
  Painter painter(way, answers, *console_.screen, terminal_ < 0 ? STDERR_FILENO : terminal_);
  Pace pace(way);
  Seconds pause(0);
  for (bool last = false; !last;) {
    last = stopped_after(pause);
    pace.start();
    const bool changed = pixels.update();
    const size_t bytes = pixels.known() ? painter.paint(pixels, live_.picture, changed, last) : 0;
    pause = pace.pause_after(bytes);
  }
  console_.screen->keep_picture();
}

std::unique_ptr<LiveViewer> start_preview(LiveRender& live, const ToneChoice& tone, const Console& console) {
  if (console.screen) {
    const int terminal = open_error_terminal();
    try {
      return std::make_unique<TerminalPreview>(live, tone, console, terminal);
    } catch (const std::system_error& error) {
      if (terminal >= 0) close(terminal);
      console.warning(fmt::format("--preview shows nothing: no thread can be started: {}", error.what()));
      return nullptr;
    }
  }
  const bool dumb = &console.err == &std::cerr && isatty(STDERR_FILENO);
  console.warning(
      fmt::format("--preview shows nothing: the error stream is {}",
                  dumb ? "a terminal that cannot redraw its lines (TERM=dumb)" : "not a terminal"));
  return nullptr;
}

}  // namespace kaustik::app
