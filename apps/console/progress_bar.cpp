#include "apps/console/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "apps/console/terminal_size.h"

namespace kaustik::app {

namespace {

constexpr double kRedrawSeconds = 0.1;  // least time between redraws on a terminal
constexpr double kLineSeconds = 5;      // least time between lines in a log

constexpr int kLogColumns = 200;

std::string duration_text(double seconds) {
  const auto whole = static_cast<uint64_t>(std::ceil(seconds));
  if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

std::string phase_text(const render::Progress& progress) {
  if (progress.passes == 0) return fmt::format("{} {}", progress.phase, progress.pass + 1);
  if (progress.passes == 1) return std::string(progress.phase);
  return fmt::format("{} {}/{}", progress.phase, progress.pass + 1, progress.passes);
}

}  // namespace

std::string progress_line(const ProgressText& text, int columns) {
  constexpr int kMostBar = 40, kLeastBar = 4, kFrame = 3;  // brackets, and the space before them
  const double inside = std::clamp(text.fraction, 0.0, 1.0);
  std::string line = fmt::format("{:<8}", text.phase);
  std::string end = fmt::format(" {:3.0f} %", std::floor(inside * 100));
  if (text.seconds_left) end += fmt::format("  ETA {}", duration_text(*text.seconds_left));
  if (!text.remark.empty()) end += "  " + text.remark;
  const int bar = std::min(kMostBar, columns - int(line.size() + end.size()) - kFrame);
  if (bar >= kLeastBar) {
    const int filled = static_cast<int>(inside * bar);
    line += fmt::format(" [{:#<{}}{:-<{}}]", "", filled, "", bar - filled);
  }
  line += end;
  if (int(line.size()) > columns) line.resize(size_t(std::max(columns, 0)));
  return line;
}

void ProgressBar::set_deadline(double seconds) {
  time_left_.set_deadline(now() + seconds);
}

TimeLeft::Estimate ProgressBar::update(const render::Progress& progress) {
  const double now = this->now();
  const TimeLeft::Estimate estimate = time_left_.update(progress, now);
  const double between = console_.screen ? kRedrawSeconds : kLineSeconds;
  if (console_.quiet || (last_drawn_ >= 0 && now - last_drawn_ < between)) return estimate;
  last_drawn_ = now;
  std::string line = progress_line({phase_text(progress), remark_, estimate.fraction, estimate.seconds},
                                   console_.screen ? terminal_size(STDERR_FILENO).columns - 1 : kLogColumns);
  if (console_.screen)
    console_.screen->show_line(std::move(line));
  else
    console_.err << line << std::endl;
  return estimate;
}

void ProgressBar::clear() {
  if (console_.screen) console_.screen->show_line("");
}

}  // namespace kaustik::app
