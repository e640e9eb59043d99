#include "apps/session/stopping/stop_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/console/exit_error.h"
#include "render/film/error_estimate.h"
#include "render/plan/pass_share.h"
#include "render/plan/plan.h"

namespace kaustik::app {

namespace {

// The radius shrinks such that both bias and noise vanish with the number of passes (Knaus and Zwicker 2011).
constexpr float kConsistentAlpha = 2.0f / 3;

bool has(const std::vector<std::string>& aov, std::string_view layer) {
  return std::find(aov.begin(), aov.end(), layer) != aov.end();
}

// Number of passes that are planned where none is given.
uint64_t passes_for(const Settings& settings, const SceneNeeds& needs) {
  if (!settings.stop.seconds || render::needs_photons(settings.render, needs)) return kErrorPasses;
  return std::clamp(uint64_t(settings.render.spp), kErrorPasses, kPathPasses);
}

}  // namespace

bool names_error_layer(const std::vector<std::string>& aov) {
  return std::any_of(aov.begin(), aov.end(),
                     [](const std::string& name) { return name == "error" || name == "bias"; });
}

void check_stop_settings(const StopSettings& stop) {
  if (stop.target_quantile && !stop.target_error)
    throw ExitError(kBadCommandLine, "--target-quantile needs --target-error");
}

void settle_error_settings(const Console& console, const SceneNeeds& needs, Settings* settings) {
  render::RenderSettings& render = settings->render;
  const bool named = names_error_layer(render.aov);
  if (named && render.passes == 1 && !settings->stop.any())
    throw ExitError(kBadCommandLine, "the layers error and bias need --passes 2 or more");
  if (render.passes == 0 && (named || settings->stop.any())) {
    render.passes = std::min(passes_for(*settings, needs), render.photons);
    const render::PassShare each = render::pass_share(0, render.passes, render.photons, render.spp);
    console.note(fmt::format("each pass takes {} of the {} samples and the same share of the photons",
                             each.end_sample, render.spp));
  }
  const bool shown = named || (has(render.aov, "all") && render.passes > 1);
  if (!render.estimate_bias && (shown || settings->stop.target_error)) render.estimate_bias = true;
  if (!render.alpha && settings->stop.any()) render.alpha = kConsistentAlpha;
}

bool StopRule::reaches_target(const render::PassSums& sums) {
  if (!settings_.target_error) return false;
  error_ = render::relative_error(render::estimate_errors(sums.totals), sums.passes.count(),
                                  settings_.target_quantile);
  if (*error_ > *settings_.target_error) return false;
  reason_ = fmt::format("target-error {}", *settings_.target_error);
  return true;
}

bool StopRule::met_by(const render::PassSums& sums) {
  if (sums.passes.empty() || reaches_target(sums)) return !reason_.empty();
  if (settings_.seconds && seconds_before_ >= *settings_.seconds)
    reason_ = fmt::format("time {}s", *settings_.seconds);
  return !reason_.empty();
}

bool StopRule::enough(const render::PassSums& sums) {
  const double now = seconds(), pass = now - last_;
  last_ = now;
  if (reaches_target(sums)) return true;
  if (has_time_for(pass) || sums.passes.count() < fewest_) return false;
  stop_for_time();
  return true;
}

bool StopRule::has_time_for(double pass) const {
  return !settings_.seconds || seconds() + pass + seconds_after_ <= *settings_.seconds;
}

void StopRule::stop_for_time() {
  reason_ = fmt::format("time {}s", *settings_.seconds);
}

std::optional<uint64_t> StopRule::passes_needed(const render::PassSums& sums) const {
  if (!error_ || !std::isfinite(*error_)) return {};
  const double times = std::pow(*error_ / *settings_.target_error, 2);
  return uint64_t(std::min(std::ceil(times * double(sums.passes.count())), double(render::kMostPasses)));
}

std::string StopRule::progress() const {
  if (!error_) return {};
  return fmt::format("error {}, target {}", percent(*error_), percent(*settings_.target_error));
}

std::string percent(double share) {
  return std::isfinite(share) ? fmt::format("{:.3g} %", 100 * share) : std::string("unknown");
}

}  // namespace kaustik::app
