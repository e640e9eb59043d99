#pragma once
// Renders that go on until they are good enough, or until their time is over.

#include <optional>
#include <string>
#include <vector>

#include "apps/console/console.h"
#include "apps/settings/settings.h"
#include "core/stopwatch.h"
#include "render/passes/pass_sums.h"

namespace kaustik::app {

// Passes that photons and samples are shared out over where an error is to be known and --passes is not
// given: enough for a standard error, and few enough for maps that hold something.
inline constexpr uint64_t kErrorPasses = 8;

// Whether layers are asked for by name that hold the error.
bool names_error_layer(const std::vector<std::string>& aov);

// Throws ExitError (bad command line) for rules that make no sense together.
void check_stop_settings(const StopSettings& stop);

// What a new render needs so that its error can be known: passes, the measured bias; and a radius that
// shrinks where passes go on as long as they have to. Only what nobody has said is changed; the log says
// what. Throws ExitError (bad command line) where what was said leaves no error to know.
void settle_error_settings(const Console& console, Settings* settings);

// Asked after each pass.
class StopRule {
 public:
  // seconds_before: of earlier commands of the same render. total: started when this one was.
  StopRule(const StopSettings& settings, double seconds_before, const Stopwatch& total)
      : settings_(settings), seconds_before_(seconds_before), total_(total), last_(seconds()) {}

  // Whether these passes are enough, before the first is rendered: then there is nothing to do.
  bool met_by(const render::PassSums& sums);
  // Whether these passes are enough, with the one that has just been rendered.
  bool enough(const render::PassSums& sums);
  // "error 3.2 %, target 1 %": of the passes seen last; empty without --target-error.
  std::string progress() const;
  // Why the render ended: empty while it goes on.
  const std::string& reason() const { return reason_; }

 private:
  bool reaches_target(const render::PassSums& sums);
  double seconds() const { return seconds_before_ + total_.seconds(); }

  StopSettings settings_;
  double seconds_before_;
  const Stopwatch& total_;
  double last_;                  // when the pass before was asked about
  std::optional<double> error_;  // relative
  std::string reason_;
};

// "1.83 %"; "unknown" for what is not finite.
std::string percent(double share);

}  // namespace kaustik::app
