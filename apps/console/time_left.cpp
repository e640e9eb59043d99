#include "apps/console/time_left.h"

#include <algorithm>

namespace kaustik::app {

double TimeLeft::in_pass(const render::Progress& progress, double now) {
  constexpr double kEnough = 0.02;  // of a phase, to judge its duration
  const double phase =
      progress.total > 0 ? std::clamp(double(progress.done) / double(progress.total), 0.0, 1.0) : 0;
  if (progress.phase == "photons") {
    has_photons_ = true;
    return before_render_ * phase;
  }
  if (progress.phase == "build") return before_render_;
  if (!has_photons_) return phase;
  if (!render_start_) render_start_ = now;
  const double before = *render_start_ - *pass_start_, rendering = now - *render_start_;
  if (phase >= kEnough && rendering > 0) before_render_ = before / (before + rendering / phase);
  return before_render_ + (1 - before_render_) * phase;
}

TimeLeft::Estimate TimeLeft::update(const render::Progress& progress, double now) {
  if (!start_) start_ = pass_start_ = now, pass_ = progress.pass;
  if (progress.pass != pass_) {
    ++finished_;
    pass_ = progress.pass;
    pass_start_ = now;
    render_start_.reset();
    has_photons_ = false;
  }
  const double done = in_pass(progress, now), elapsed = now - *start_;
  const uint64_t end = end_.value_or(progress.passes);
  double fraction = done;
  Estimate estimate;
  if (deadline_) {
    estimate.seconds = std::max(0.0, *deadline_ - now);
    fraction = *deadline_ > *start_ ? std::min(elapsed / (*deadline_ - *start_), 1.0) : 1;
  } else if (end > pass_) {
    const double passes = double(finished_) + done, left = double(end - pass_) - done;
    fraction = passes / (passes + left);
    if (passes > 0) estimate.seconds = elapsed * left / passes;
  } else {
    return {done, {}};
  }
  estimate.fraction = fraction_ = std::max(fraction_, fraction);
  return estimate;
}

}  // namespace kaustik::app
