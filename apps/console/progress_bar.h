#pragma once
// Shows the progress of a render and its estimated time left on one line.

#include <chrono>
#include <optional>
#include <string>

#include "apps/console/console.h"
#include "apps/console/time_left.h"

namespace kaustik::app {

// What the line says.
struct ProgressText {
  std::string phase, remark;
  double fraction = 0;
  std::optional<double> seconds_left;
};

// For example "photons  [########------------]  40 %  ETA 1:05", with at most `columns` characters: first the
// bar becomes shorter, then the end is cut.
std::string progress_line(const ProgressText& text, int columns);

// Redraws its line in place on a terminal, and writes a new line every few seconds elsewhere; silent when
// console.quiet. The bar and the time left are those of the whole render. update() is not thread-safe: the
// renderer serialises its calls.
class ProgressBar {
 public:
  explicit ProgressBar(const Console& console) : console_(console) {}
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // Returns what the line says of the whole render, also if nothing is drawn.
  TimeLeft::Estimate update(const render::Progress& progress);
  // Sets a text that is appended to every line from now on.
  void remark(std::string text) { remark_ = std::move(text); }
  // See TimeLeft. `seconds`: from now on.
  void set_end(uint64_t pass) { time_left_.set_end(pass); }
  void set_deadline(double seconds);
  // Removes the bar from the terminal.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  // Seconds since the bar exists.
  double now() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  const Console& console_;
  std::string remark_;
  TimeLeft time_left_;
  Clock::time_point start_ = Clock::now();
  // On a terminal the first line is drawn at once; in a log it comes after kLineSeconds.
  double last_drawn_ = console_.screen ? -1 : 0;
};

}  // namespace kaustik::app
