#include "apps/session/stopping/fixed_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/session/stopping/path_choice.h"
#include "apps/settings/unread_settings.h"
#include "render/camera/pixel_range.h"
#include "render/passes/passes.h"
#include "render/plan/pass_share.h"

namespace kaustik::app {

namespace {

// All trials together render at most kTrialShare as many samples as the render has samples and photons. With
// fewer than kFewestWindows windows there is no trial. The photons of the trials come on top.
constexpr double kTrialShare = 0.02, kFewestWindows = 12;
constexpr double kMostWindows = 120;
// Paths are not taken where they leave this many times the error with as many samples, however fast they are:
// then the settings ask for photons rather than for samples.
constexpr double kMostNoise = 2;
constexpr uint64_t kTrialPhotons = 1u << 16;
constexpr double kMostTrials = 3;  // with maps, with paths for indirect light, and for caustics too

class FixedPlan {
 public:
  FixedPlan(const Scene& scene, const accel::Bvh& bvh, Settings* settings)
      : scene_(scene),
        bvh_(bvh),
        render_(settings->render),
        plan_(render::make_plan(render_, scene.needs)),
        open_ended_(settings->stop.any()),
        pixels_(double(render::rendered_range(render_.crop, scene.camera).pixels())) {}

  // The number of trial windows; 0: no trial.
  double windows() const {
    if (path_candidates(scene_, render_, plan_).empty()) return 0;
    const double work = pixels_ * render_.spp + double(render_.photons);
    constexpr double kWindowSamples =
        kMostTrials * render::kTrialSamples * render::kTrialWindow * render::kTrialWindow;
    const double windows = std::min(kTrialShare * work / kWindowSamples, kMostWindows);
    return windows < kFewestWindows ? 0 : windows;
  }

  TrialWork settle(double windows, const render::ProgressCallback& progress) {
    render::EstimatorPlan plan = plan_;
    passes_ = render::choose_passes(scene_, bvh_, render_, &plan);
    const auto first = std::make_shared<render::FirstPhotons>();
    const TrialWork found{nullptr, first->photons.explored(), {}};
    render::PassShare share = render::pass_share(0, passes_, render_.photons, render_.spp);
    const uint64_t all = std::exchange(share.photons, std::min(share.photons, kTrialPhotons));
    if (!first->photons.make(input(), share, progress, &first->statistics)) return found;
    if (std::optional<PathTrial> paths = try_paths(windows, share, first.get())) {
      render_ = std::move(paths->settings);
      return {nullptr, found.explored, options_of(paths->classes)};
    }
    if (passes_ > 1 || open_ended_) return found;
    share.photons = all;
    first->photons.forget_radii();
    first->statistics = {};
    first->statistics.photon_build_s = found.explored->seconds;
    first->photons.make(input(), share, progress, &first->statistics);
    return {first, found.explored, {}};
  }

 private:
  render::RenderInput input() const { return {scene_, bvh_, render_, plan_}; }

  // share: the pass whose photons the trial has.
  std::optional<PathTrial> try_paths(double windows, const render::PassShare& share,
                                     render::FirstPhotons* first) const {
    const auto trial = [&](const render::RenderInput& tried) {
      return render::try_one_sample(tried, {.windows = windows}, false, &first->photons);
    };
    const render::SampleTrial maps = trial(input());
    const double photons = double(render_.photons);
    const double photon_rays = rays_of(first->statistics) * photons / double(share.photons);
    const double samples = render_.spp * (1 + double(passes_ == 1 ? render_.adaptive : 0));
    const auto judge = [&](const TrialComparison& found, const PathTrial& paths) {
      const double of_maps = found.variance_of_maps / samples +
                             found.error_of_maps * share_of_map_error(double(share.photons), photons);
      const double of_paths = found.variance_of_paths / render_.spp;
      const double beside = render::kinds_needed(paths.plan).any() ? photon_rays : 0;
      const double work =
          (work_of(paths.sample, render_.spp) + beside) / (work_of(maps, samples) + photon_rays);
      return ErrorsAtCost{of_maps, of_paths > kMostNoise * of_maps ? HUGE_VAL : of_paths * work};
    };
    return choose_paths(input(), maps, trial, judge);
  }

  // In rays. Samples of a pixel share gathers within a pass, so the number of gathers grows about half as
  // fast as the number of samples.
  double work_of(const render::SampleTrial& sample, double samples) const {
    const double passes = double(passes_);
    return sample.rays * samples + sample.gathers * passes * std::max(1.0, samples / passes / 4);
  }

  static double rays_of(const render::RenderStatistics& s) {
    return double(s.photons.rays) + double(s.guided.rays);
  }

  const Scene& scene_;
  const accel::Bvh& bvh_;
  render::RenderSettings& render_;
  render::EstimatorPlan plan_;
  uint64_t passes_ = 1;
  bool open_ended_;  // passes follow until a rule stops the render
  double pixels_;
};

}  // namespace

bool may_choose_paths(const Settings& settings, const SettingOverrides& given, const SceneNeeds& needs) {
  if (given.sets("photons") || settings.render.estimate_bias.value_or(false)) return false;
  const render::RenderSettings paths = with_paths(settings.render, TakenByPaths::kIndirectAndCaustics);
  const auto unread = [&](const render::RenderSettings& render) {
    return unread_settings(given, render::make_plan(render, needs)).size();
  };
  return unread(paths) <= unread(settings.render);
}

TrialWork settle_paths(const Scene& scene, const accel::Bvh& bvh, const render::ProgressCallback& progress,
                       Settings* settings) {
  FixedPlan plan(scene, bvh, settings);
  const double windows = plan.windows();
  return windows > 0 ? plan.settle(windows, progress) : TrialWork{};
}

}  // namespace kaustik::app
