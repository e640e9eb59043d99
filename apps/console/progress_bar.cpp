#include "apps/console/progress_bar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kaustik::app {

namespace {

constexpr double kRedrawSeconds = 0.1;  // least time between redraws on a terminal
constexpr double kLineSeconds = 5;      // least time between lines in a log

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

std::string progress_line(std::string_view phase, double fraction, double left) {
  constexpr int kWidth = 40;
  const double inside = std::clamp(fraction, 0.0, 1.0);
  const int filled = static_cast<int>(inside * kWidth);
  const std::string eta = left < 0 ? std::string() : fmt::format("  ETA {}", duration_text(left));
  return fmt::format("{:<8} [{:#<{}}{:-<{}}] {:3.0f} %{}", phase, "", filled, "", kWidth - filled,
                     std::floor(inside * 100), eta);
}

void ProgressBar::update(const render::Progress& progress) {
  if (console_.quiet) return;
  const Clock::time_point now = Clock::now();
  const std::string phase = phase_text(progress);
  if (phase_ != phase) {
    phase_ = phase;
    phase_start_ = now;
  }
  const std::chrono::duration<double> since_drawn = now - last_drawn_, elapsed = now - phase_start_;
  if (since_drawn.count() < (console_.terminal ? kRedrawSeconds : kLineSeconds)) return;
  last_drawn_ = now;
  const double done = static_cast<double>(progress.done), total = static_cast<double>(progress.total);
  const double left = done > 0 ? elapsed.count() * (total - done) / done : -1;
  std::string line = progress_line(phase_, total > 0 ? done / total : 0, left);
  if (!remark_.empty()) line += "  " + remark_;
  if (console_.terminal) {
    console_.err << '\r' << line << "\x1b[K" << std::flush;
    visible_ = true;
  } else {
    console_.err << line << std::endl;
  }
}

void ProgressBar::clear() {
  if (visible_) console_.err << "\r\x1b[K" << std::flush;
  visible_ = false;
}

}  // namespace kaustik::app
