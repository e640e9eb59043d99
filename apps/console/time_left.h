#pragma once
// Estimates how long a render still takes, over all of its phases and passes.

#include <cstdint>
#include <optional>
#include <string>

#include "render/plan/progress.h"

namespace kaustik::app {

// A pass shoots photons, builds their maps and renders. The share of a pass that comes before rendering is
// taken to be a half until a pass shows what it is. Times are in seconds, from any start.
class TimeLeft {
 public:
  struct Estimate {
    double fraction = 0;            // done of all work, from 0 to 1; it never falls
    std::optional<double> seconds;  // until the end of the render; unset while it is unknown
  };

  // The index after the last pass, where it differs from Progress::passes. 0 = unknown.
  void set_end(uint64_t pass) { end_ = pass; }
  // The time at which the render ends, whatever it has done by then.
  void set_deadline(double seconds) { deadline_ = seconds; }

  Estimate update(const render::Progress& progress, double now);

 private:
  // The share of the current pass that is done.
  double in_pass(const render::Progress& progress, double now);

  std::optional<uint64_t> end_;
  std::optional<double> deadline_, start_, pass_start_, render_start_;
  uint64_t pass_ = 0, finished_ = 0;  // the current pass; passes that this object saw to their end
  bool has_photons_ = false;          // in the current pass
  double before_render_ = 0.5;        // the share of a pass before its rendering
  double fraction_ = 0;
};

}  // namespace kaustik::app
