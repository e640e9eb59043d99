#pragma once
// Shows the picture in progress in the terminal, above the progress line.

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "apps/console/console.h"
#include "apps/live/live_render.h"
#include "apps/live/terminal/picture_place.h"
#include "apps/live/terminal/terminal_graphics.h"
#include "apps/settings/table/settings.h"

namespace kaustik::app {

class TerminalPreview : public LiveViewer {
 public:
  // terminal: the file of console.screen's terminal, open to be read, which the preview closes at its end; or
  // -1. `live` and `console` must outlive it.
  TerminalPreview(LiveRender& live, const ToneChoice& tone, const Console& console, int terminal);
  // Draws the final picture, which stays.
  ~TerminalPreview() override;

 private:
  void run(const ToneChoice& tone);
  void show(PictureWay way, const TerminalAnswers& answers, const ToneChoice& tone);
  bool stopped_after(std::chrono::duration<double> time);

  LiveRender& live_;
  const Console& console_;
  const int terminal_;
  std::mutex mutex_;
  std::condition_variable stop_;
  bool stopping_ = false;
  std::thread thread_;  // the last member: it uses the others
};

// Starts the preview on the terminal of the error stream. Where it cannot be shown, a warning says why, and
// there is none.
std::unique_ptr<LiveViewer> start_preview(LiveRender& live, const ToneChoice& tone, const Console& console);

}  // namespace kaustik::app
