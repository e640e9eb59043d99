#pragma once
// Rules that stop a render when its error is small enough or its time is up.

#include <optional>
#include <string>
#include <vector>

#include "apps/console/console.h"
#include "apps/settings/table/settings.h"
#include "core/scene/scene.h"
#include "core/stopwatch.h"
#include "render/passes/pass_sums.h"

namespace kaustik::app {

// Number of passes when an error estimate is needed and --passes is not given. Photons and samples are
// divided among the passes: eight are enough for a standard error and leave each photon map a useful size.
inline constexpr uint64_t kErrorPasses = 8;
// Most passes that are planned where paths without photons fill a time, if there are as many samples. The
// shorter the passes are, the better the render keeps to its time; this many cost it a few per cent.
inline constexpr uint64_t kPathPasses = 32;

// Whether `aov` names the layer error or bias.
bool names_error_layer(const std::vector<std::string>& aov);

// Throws ExitError (bad command line) for a target quantile without a target error.
void check_stop_settings(const StopSettings& stop);

// Chooses settings that a new render needs for its error estimate: several passes, a bias estimate, and, with
// a stop rule, a radius that shrinks from pass to pass. Changes only settings that the user left open, and
// logs the passes. Throws ExitError (bad command line) when the user's settings allow no error estimate.
void settle_error_settings(const Console& console, const SceneNeeds& needs, Settings* settings);

// Decides after each pass whether to stop.
class StopRule {
 public:
  // `seconds_before`: time spent by earlier commands on the same render. `total`: started with this command.
  // `seconds_after`: what follows the last pass, for which time is left. `fewest`: passes that there must be,
  // whatever time they take.
  StopRule(const StopSettings& settings, double seconds_before, const Stopwatch& total,
           double seconds_after = 0, uint64_t fewest = 1)
      : settings_(settings),
        seconds_before_(seconds_before),
        seconds_after_(seconds_after),
        fewest_(fewest),
        total_(total),
        last_(seconds()) {}

  // Whether the passes of an earlier command already suffice.
  bool met_by(const render::PassSums& sums);
  // Whether these passes suffice; call it after each pass. Also stops when another pass as long as the last
  // would exceed the time.
  bool enough(const render::PassSums& sums);
  // The two rules alone, for passes that are rendered side by side: whether the sums reach the target error,
  // and whether a further pass that takes so many seconds would end in time. stop_for_time(): no pass would.
  bool reaches_target(const render::PassSums& sums);
  bool has_time_for(double pass) const;
  void stop_for_time();
  // How many passes the target error takes in all, by the noise of those checked last; unset without a
  // target. Noise falls with the square root of the number of passes.
  std::optional<uint64_t> passes_needed(const render::PassSums& sums) const;
  // For example "error 3.2 %, target 1 %", for the passes checked last; empty without --target-error.
  std::string progress() const;
  // The rule that ended the render, such as "target-error 0.01"; empty while it goes on.
  const std::string& reason() const { return reason_; }

 private:
  double seconds() const { return seconds_before_ + total_.seconds(); }

  StopSettings settings_;
  double seconds_before_, seconds_after_;
  uint64_t fewest_;
  const Stopwatch& total_;
  double last_;                  // seconds() at the last check
  std::optional<double> error_;  // relative
  std::string reason_;
};

// For example "1.83 %" for 0.0183; "unknown" if it is not finite.
std::string percent(double share);

}  // namespace kaustik::app
