#pragma once
// One line that shows how far a render is and when it will be done.

#include <chrono>
#include <string>

#include "apps/console/console.h"
#include "render/renderer.h"

namespace kaustik::app {

// "photons  [########------------]  40 %  1:05 left". left: seconds, negative when unknown.
std::string progress_line(std::string_view phase, double fraction, double left);

// On a terminal the line is redrawn in place; elsewhere a new line comes every few seconds; nothing when
// quiet. update() is not thread-safe: the renderer serialises its calls.
class ProgressBar {
 public:
  explicit ProgressBar(const Console& console) : console_(console) {}
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void update(const render::Progress& progress);
  // Follows every line from now on.
  void remark(std::string text) { remark_ = std::move(text); }
  // Takes the bar off the terminal.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  const Console& console_;
  std::string phase_, remark_;
  // On a terminal the first line comes at once, in a log when there is something to say.
  Clock::time_point phase_start_, last_drawn_ = console_.terminal ? Clock::time_point() : Clock::now();
  bool visible_ = false;
};

}  // namespace kaustik::app
