#include "apps/session/stopping/time_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "apps/session/stopping/source_choice.h"
#include "apps/session/stopping/stop_rules.h"
#include "render/camera/pixel_range.h"
#include "render/passes/passes.h"

namespace kaustik::app {

namespace {

// Shares of the time: the least and the most that photons get, and a reserve.
constexpr double kLeastPhotons = 0.03, kMostPhotons = 0.5, kMargin = 0.03;
// The denoiser compares two halves of the samples of a pixel.
constexpr int kFewestFiltered = 2;
// Shares of the time for trials: of few photons, after which no larger trial follows if they took longer; and
// of samples.
constexpr double kPhotonTrial = 0.1, kSampleTrial = 0.03;
// Where exploring the scene took more than this share of the time that was left, no trials follow.
constexpr double kHurry = 0.2;
// The least time for photons, as a multiple of that of exploring.
constexpr double kShootPerExplored = 3;
// Share of the time that is left which the base samples may take by the trial. The rest is for adaptive
// samples: a picture without any has more noise than one of half the samples and some.
constexpr double kSure = 0.6;
// Without adaptive samples, which nothing replaces where trials were wrong.
constexpr double kSureWithout = 0.8;
// For films, their mean and writing the files.
constexpr double kSecondsPerPixel = 3e-7;
// Most adaptive samples per base sample. Measured: up to 3 they are worth about as much as base samples.
// More are needed only where the trials overestimated the cost of a sample.
constexpr double kMostAdaptive = 12;
// Least work of adaptive samples, even where the first samples have used the time up: without any, the exact
// sums would have another unit (units_of() in render/renderer.cpp).
constexpr double kLeastAdaptive = 0.01;
// A render is split into passes if it would take longer than this (seconds) and fit this many samples per
// pixel: a single pass would show nothing for long, and more adaptive samples would hardly be placed better.
constexpr double kLongPass = 4;
constexpr int kManySamples = 64;
constexpr int kPasses = 10, kMostSamples = 32;  // planned passes, and samples of each
constexpr int kMostOfOne = 4096;                // samples of a single pass
// Fewest photons for any time: this share of the scene's number, but not more than kEnoughPhotons.
constexpr double kFewestPhotons = 1.0 / 16, kEnoughPhotons = 62'500;

// The next larger candidate for the samples per pixel. Powers of two are distributed best; without adaptive
// samples to fill the rest of the time, numbers in between are candidates too.
int next_number(int spp, double adaptive) {
  if (adaptive > 0) return 2 * spp;
  return spp + (spp < 4 ? 1 : std::max(2, int(std::bit_floor(unsigned(spp))) / 4));
}

// The largest candidate that fits into `seconds`; at least one.
int samples_within(const render::SampleCost& cost, double adaptive, double seconds, int most) {
  int spp = 1;
  for (int more = next_number(1, adaptive); more <= most && cost.of(more, adaptive) <= seconds;
       more = next_number(more, adaptive))
    spp = more;
  return spp;
}

// The photons that fit beside what their shoot learns, rounded down to two digits, so that the log can state
// them exactly.
uint64_t photons_within(const render::PhotonCost& cost, double seconds, double fewest) {
  const double photons = std::clamp(seconds / cost.each, std::max(fewest, 10.0), 1e12);
  const double unit = std::pow(10.0, std::floor(std::log10(photons)) - 1);
  return uint64_t(std::floor(photons / unit) * unit);
}

// The cost of samples where only the time of one is known.
render::SampleCost cost_of(double one_sample) {
  return {.each = one_sample, .each_adaptive = one_sample};
}

constexpr const char* kNoTimeForMaps = "there is no time to make photon maps: paths take their place";
constexpr const char* kPathsDoBetter =
    "photons take more of the time than they are worth: paths take their place";

// Runs the trials and makes the choice.
class TimePlan {
 public:
  TimePlan(const Scene& scene, const accel::Bvh& bvh, const Stopwatch& total, double seconds_after,
           const render::ProgressCallback& progress, Settings* settings)
      : scene_(scene),
        bvh_(bvh),
        total_(total),
        progress_(progress),
        seconds_(*settings->stop.seconds),
        render_(settings->render),
        plan_(render::make_plan(render_, scene.needs)),
        gathers_(render::kinds_needed(plan_).any()),
        fewest_(std::min(kFewestPhotons * double(render_.photons), kEnoughPhotons)),
        seconds_after_(seconds_after) {}

  FilledTime settle() {
    if (!gathers_) return settle_by_trials();
    const double before = left();
    // Exploring takes at most about as long as loading did.
    if (before < total_.seconds() && may_take_paths()) return take_paths_at_once();
    settle_sources();
    if (!gathers_) return settle_by_trials();
    if (!worth_.light) return few_photons();
    render::PassPhotons(explored_).explore(input(), progress_);
    return explored_->seconds > kHurry * before ? hurry() : settle_by_trials();
  }

 private:
  render::RenderInput input() const { return {scene_, bvh_, render_, plan_}; }

  double left() const {
    const uint64_t pixels = render::rendered_range(render_.crop, scene_.camera).pixels();
    return (1 - kMargin) * seconds_ - total_.seconds() - kSecondsPerPixel * double(pixels) - seconds_after_;
  }

  FilledTime settle_by_trials() {
    render::PhotonTrial trial;
    if (gathers_) trial = render::try_photons(input(), kPhotonTrial * seconds_, progress_, explored_);
    auto first = std::make_shared<render::FirstPhotons>(std::move(trial.first));
    if (cancelled(*first)) return {.single_pass = true, .photons = std::move(first)};
    const double sample = render::try_one_sample(input(), kSampleTrial / 3 * seconds_, &first->photons);
    if (has_no_time_for(sample, trial.cost.fixed + trial.cost.each * fewest_)) return take_paths_at_once();
    if (paths_do_better(trial.cost, sample, &first->photons)) return take_paths(kPathsDoBetter);
    const double share = gathers_ ? photon_share(trial.cost, sample) : 0;
    if (takes_passes(sample, share)) {
      fill_passes(trial.cost, cost_of(sample), share);
      return {.explored = explored_, .sources = sources_};
    }
    if (gathers_) *first = shoot(photons_of_share(trial.cost, share));
    const render::SampleCost cost = render::try_samples(input(), kSampleTrial * seconds_, &first->photons);
    return one_pass(cost, gathers_ ? std::move(first) : nullptr);
  }

  // A single pass of as many samples as fit.
  FilledTime one_pass(const render::SampleCost& cost, std::shared_ptr<render::FirstPhotons> photons) {
    const float adaptive = adaptive_samples() ? render_.adaptive : 0;
    render_.spp = samples_within(cost, adaptive, (adaptive > 0 ? kSure : kSureWithout) * left(), kMostOfOne);
    if (render_.denoise.value_or(false)) render_.spp = std::max(render_.spp, kFewestFiltered);
    return {.single_pass = true,
            .photons = std::move(photons),
            .explored = explored_,
            .sources = sources_,
            .adaptive_work = adaptive_work(cost)};
  }

  // Whether paths should take the place of maps because half a sample no longer fits beside the photons.
  bool has_no_time_for(double one_sample, double seconds_of_photons) const {
    return may_take_paths() && left() - seconds_of_photons < one_sample / 2;
  }

  // Where there is no time for trials: the fewest photons, or paths where there is no time for those either.
  FilledTime hurry() {
    if (may_take_paths() && left() < kShootPerExplored * explored_->seconds) return take_paths_at_once();
    const auto first = std::make_shared<render::FirstPhotons>(shoot(fewest_photons()));
    if (cancelled(*first)) return {.single_pass = true, .photons = first};
    const double sample = render::try_one_sample(input(), kSampleTrial * seconds_, &first->photons);
    if (has_no_time_for(sample, 0)) return take_paths_at_once();
    first->photons.forget_visibility();  // it depends on the number of samples
    return one_pass(cost_of(sample), first);
  }

  bool may_take_paths() const {
    return given_.method == render::Method::kAuto && !given_.indirect && reads_indirect_photons(divided_);
  }

  // Whether paths have less error in the time of photons and samples: the prediction of errors is for as many
  // samples.
  bool paths_do_better(const render::PhotonCost& photons, double sample, render::PassPhotons* maps) const {
    if (!gathers_ || !may_take_paths()) return false;
    const render::RenderSettings by_paths = settings_of_paths();
    const render::EstimatorPlan plan = render::make_plan(by_paths, scene_.needs);
    if (render::kinds_needed(plan).any()) return false;
    const render::RenderInput input{scene_, bvh_, by_paths, plan};
    const double of_path = render::try_one_sample(input, kSampleTrial / 3 * seconds_, maps);
    const double all = photons.each * double(given_.photons) + sample * given_.spp;
    return worth_.error * all > of_path * given_.spp;
  }

  render::RenderSettings settings_of_paths() const {
    render::RenderSettings open = render_;
    open.caustics = given_.caustics, open.indirect = given_.indirect;
    return with_paths(open, divided_, scene_);
  }

  // Passes of one sample by paths.
  FilledTime take_paths(const char* because) {
    adopt(settings_of_paths());
    sources_ = options_of(render_, given_);
    FilledTime filled = few_photons();
    filled.sources_because = because;
    return filled;
  }

  // The same where there is no time to explore the scene.
  FilledTime take_paths_at_once() {
    render_.final_gather = false;
    return take_paths(kNoTimeForMaps);
  }

  // Passes of one sample, with photons that look for the little light that paths may miss.
  FilledTime few_photons() {
    render_.photons = kErrorPasses * fewest_photons();
    set_passes(1);
    return {.explored = explored_, .sources = sources_};
  }

  // Names photons or paths where one of them does as well alone.
  void settle_sources() {
    render::RenderSettings settled = render_;
    sources_ = app::settle_sources(scene_, bvh_, &settled, nullptr, &worth_);
    adopt(settled);
  }

  void adopt(const render::RenderSettings& settings) {
    render_ = settings;
    plan_ = render::make_plan(render_, scene_.needs);
    gathers_ = render::kinds_needed(plan_).any();
  }

  uint64_t fewest_photons() const { return photons_within({.each = 1}, 0, fewest_); }

  bool cancelled(const render::FirstPhotons& first) const { return gathers_ && !first.photons.radii(); }

  render::FirstPhotons shoot(uint64_t photons) {
    render_.photons = photons;
    render_.photons /= render::choose_passes(scene_, bvh_, render_, &plan_);
    return render::shoot_first(input(), progress_, explored_);
  }

  bool adaptive_samples() const { return render_.adaptive > 0 && !render::traces_paths(plan_); }

  // Whether the time is filled by passes. Paths alone share nothing that a single pass would make once, and
  // where they bring all indirect light, they have most of the time.
  bool takes_passes(double one_sample, double share) const {
    if (!gathers_) return true;
    const double each = one_sample * (adaptive_samples() ? 1 + double(render_.adaptive) : 1);
    const bool by_paths = plan_.indirect == render::IndirectEstimator::kPaths;
    const int samples = by_paths ? int(kErrorPasses) : kManySamples;
    return seconds_ > kLongPass && each * samples < (1 - share) * left();
  }

  // The adaptive samples that fit by the time that samples took so far. Rounded down to hundredths, so that
  // the log can state them exactly. Until there are some, they are taken to cost as in the trial.
  std::function<double(double, double)> adaptive_work(const render::SampleCost& cost) const {
    if (!adaptive_samples()) return {};
    const double spp = render_.spp;
    const double trial = std::max(spp * cost.each_adaptive / cost.of(spp, 0), 0.1);
    return [plan = *this, trial, before = 0.0](double done, double seconds) mutable {
      const double each = done > 0 ? seconds / (done - before) : seconds * trial;
      before = done;
      const double fits = done + plan.left() / std::max(each, 1e-9);
      return double(
          float(std::clamp(std::floor(100 * fits) / 100, std::max(done, kLeastAdaptive), kMostAdaptive)));
    };
  }

  // What a shoot takes whatever its number of photons is taken as at most half of the time.
  double fixed(const render::PhotonCost& photons) const { return std::min(photons.fixed, left() / 2); }

  // The share that photons get of the time that is left without that. Photons and samples have the ratio of
  // the settings, as if their quality were higher or lower.
  double photon_share(const render::PhotonCost& photons, double sample) const {
    const double of_photons = photons.each * double(given_.photons), of_samples = sample * given_.spp;
    return std::clamp(of_photons / (of_photons + of_samples), kLeastPhotons, kMostPhotons);
  }

  uint64_t photons_of_share(const render::PhotonCost& photons, double share) const {
    return photons_within(photons, share * (left() - fixed(photons)), fewest_);
  }

  // Plans equal passes without adaptive samples. Photons and samples are set to the sum over kErrorPasses of
  // them.
  void fill_passes(const render::PhotonCost& photons, const render::SampleCost& samples, double share) {
    const double each = left() / kPasses;
    const int spp = samples_within(samples, 0, (1 - share) * each, kMostSamples);
    if (gathers_)  // only the first pass has the fixed cost
      render_.photons =
          kErrorPasses * photons_within({.each = photons.each}, share / (1 - share) * samples.of(spp, 0),
                                        fewest_ / kErrorPasses);
    set_passes(spp);
  }

  // spp: samples of each pass. Call it when the photons are set.
  void set_passes(int spp) {
    render_.spp = int(kErrorPasses) * spp;
    render_.passes = std::max(kErrorPasses, render::choose_passes(scene_, bvh_, render_, &plan_));
  }

  const Scene& scene_;
  const accel::Bvh& bvh_;
  const Stopwatch& total_;
  const render::ProgressCallback& progress_;
  double seconds_;
  render::RenderSettings& render_;
  render::EstimatorPlan plan_;
  bool gathers_;   // whether there are photons at all
  double fewest_;  // photons
  double seconds_after_;
  // As the settings were.
  render::RenderSettings given_ = render_;
  render::EstimatorPlan divided_ = plan_;
  std::string sources_;  // the options that name photons or paths
  PhotonWorth worth_;    // of what was chosen
  std::shared_ptr<render::ExploredScene> explored_ = std::make_shared<render::ExploredScene>();
};

}  // namespace

bool time_decides(const Settings& settings, const SettingOverrides& given, const SceneNeeds& needs,
                  bool writes_passes) {
  const bool said = given.sets("photons") || given.sets("spp") || given.sets("quality");
  const bool passes = settings.render.passes > 0 || settings.stop.target_error || writes_passes ||
                      names_error_layer(settings.render.aov) || settings.render.estimate_bias.value_or(false);
  const render::EstimatorPlan plan = render::make_plan(settings.render, needs);
  return settings.stop.seconds && !said && !passes &&
         (render::kinds_needed(plan).any() || !render::traces_paths(plan));
}

FilledTime settle_time(const Scene& scene, const accel::Bvh& bvh, const Stopwatch& total,
                       double seconds_after, const render::ProgressCallback& progress, const Console& console,
                       Settings* settings) {
  FilledTime filled = TimePlan(scene, bvh, total, seconds_after, progress, settings).settle();
  if (filled.photons && !filled.photons->photons.radii()) return filled;
  if (!filled.single_pass) settle_error_settings(console, scene.needs, settings);
  const render::RenderSettings& render = settings->render;
  const std::string choice =
      filled.single_pass ? (filled.adaptive_work ? ", and adaptive samples until the time is up" : "")
                         : fmt::format(" --passes {} --alpha {}, and more passes until the time is up",
                                       render.passes, *render.alpha);
  if (filled.sources_because) console.note(filled.sources_because);
  console.note(fmt::format("--time {}s is rendered with --spp {} --photons {}{}{}", *settings->stop.seconds,
                           render.spp, render.photons, filled.sources, choice));
  return filled;
}

}  // namespace kaustik::app
