#pragma once
// Shows the progress of a render and its estimated time left on one line.

#include <chrono>
#include <string>

#include "apps/console/console.h"
#include "render/renderer.h"

namespace kaustik::app {

// For example "photons  [########------------]  40 %  ETA 1:05". `left`: seconds, negative when unknown.
std::string progress_line(std::string_view phase, double fraction, double left);

// Redraws its line in place on a terminal, and writes a new line every few seconds elsewhere; silent when
// console.quiet. update() is not thread-safe: the renderer serialises its calls.
class ProgressBar {
 public:
  explicit ProgressBar(const Console& console) : console_(console) {}
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void update(const render::Progress& progress);
  // Sets a text that is appended to every line from now on.
  void remark(std::string text) { remark_ = std::move(text); }
  // Removes the bar from the terminal.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  const Console& console_;
  std::string phase_, remark_;
  // On a terminal the first line is drawn at once; in a log it comes after kLineSeconds.
  Clock::time_point phase_start_, last_drawn_ = console_.terminal ? Clock::time_point() : Clock::now();
  bool visible_ = false;
};

}  // namespace kaustik::app
