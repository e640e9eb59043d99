// render(): for each pass shoots photons, builds maps and renders tiles; then combines the passes.

#include "render/renderer.h"

#include <fmt/format.h>

#include <mutex>
#include <stdexcept>

#include "core/parallel/work_span.h"
#include "core/stopwatch.h"
#include "render/adaptive/sample_counts.h"
#include "render/camera/pixel_range.h"
#include "render/film/error_estimate.h"
#include "render/maps/pass_photons.h"
#include "render/passes/passes.h"
#include "render/plan/pass_share.h"
#include "render/tiles/tiles.h"

namespace kaustik::render {

namespace {

void require(bool condition, const std::string& message) {
  if (!condition) throw std::invalid_argument(message);
}

void check_settings(const RenderSettings& s, const Camera& camera) {
  require(camera.width > 0 && camera.height > 0, "the image has no pixels");
  require(s.spp >= 1, "spp must be at least 1");
  require(s.max_bounces >= 1, "max_bounces must be at least 1");
  require(!s.radius || (*s.radius > 0 && std::isfinite(*s.radius)), "radius must be positive and finite");
  require(s.radius_factor > 0 && std::isfinite(s.radius_factor), "radius factor must be positive and finite");
  require(!s.alpha || (*s.alpha > 0 && *s.alpha <= 1), "alpha must be above 0 and at most 1");
  require(s.cone_k >= 1, "cone_k must be at least 1");
  if (s.crop.empty()) return;
  const bool inside =
      s.crop.x0 >= 0 && s.crop.y0 >= 0 && s.crop.x1 <= camera.width && s.crop.y1 <= camera.height;
  require(inside, fmt::format("crop {} {} {} {} lies outside the image of {} x {} pixels", s.crop.x0,
                              s.crop.x1, s.crop.y0, s.crop.y1, camera.width, camera.height));
}

template <class Pixel>
PixelWindow<Pixel> make_window(const CropWindow& crop, const Camera& camera) {
  const PixelRange range = rendered_range(crop, camera);
  return {range.width(), range.height(), range.x0, range.y0, camera.width, camera.height};
}

// Wraps the callback so that calls do not overlap, and sets the number of passes.
ProgressCallback serialised(const ProgressCallback& progress, uint64_t passes) {
  if (!progress) return {};
  return [&progress, passes, mutex = std::make_shared<std::mutex>()](Progress p) {
    const std::lock_guard lock(*mutex);
    p.passes = passes;
    return progress(p);
  };
}

// Renders the passes of one render, one after the other, and holds the state that they share.
class PassRenderer {
 public:
  // radii: r0, if an earlier render settled it.
  PassRenderer(const RenderInput& input, uint64_t shares, const RenderTask& task,
               const std::optional<GatherRadii>& radii, ProgressCallback progress)
      : input_(input),
        shares_(shares),
        first_(task.photons),
        adaptive_work_(task.adaptive_work),
        on_pixels_(task.on_pixels),
        progress_(std::move(progress)),
        photons_(radii, task.explored ? task.explored : std::make_shared<ExploredScene>()) {}

  // Determines r0 if this render does not begin with the first pass: shoots that pass's photons only for r0,
  // and does not count them.
  bool settle_radii() {
    if (photons_.radii() || !kinds_needed(input_.plan).any()) return true;
    if (input_.settings.radius) return true;  // any pass sets it
    RenderStatistics ignored;
    return photons_.make(input_, share(0), progress_, &ignored);
  }
  const std::optional<GatherRadii>& radii() const { return photons_.radii(); }

  PassShare share(uint64_t pass) const {
    return pass_share(pass, shares_, input_.settings.photons, input_.settings.spp);
  }

  // Renders one pass into a film of zeros. has_maps: called before the tiles. False when the progress
  // callback cancelled.
  bool render(uint64_t pass, const std::function<void()>& has_maps, PassFilm* film,
              RenderStatistics* statistics) {
    const PassShare part = share(pass);
    if (!make_maps(part, statistics)) return false;
    has_maps();
    const RenderContext ctx{input_,
                            photons_.maps(),
                            photons_.visibility(),
                            photons_.sky(),
                            part,
                            pass_samples(part, input_.settings, input_.plan),
                            camera_cone(input_.scene.camera, part.end_sample)};
    const PhaseWatch watch;
    const bool finished = render_tiles(ctx, progress_, film, statistics, adaptive_work_, on_pixels_);
    on_pixels_ = {};  // later passes are added to a picture that is there
    statistics->render_s += watch.end("render");
    statistics->passes += finished;
    return finished;
  }

 private:
  bool make_maps(const PassShare& pass, RenderStatistics* statistics) {
    if (first_) {
      if (!first_->photons.radii()) return false;  // cancelled
      photons_ = std::move(first_->photons);
      *statistics = first_->statistics;
      first_.reset();
    } else if (!photons_.make(input_, pass, progress_, statistics)) {
      return false;
    }
    photons_.predict_visibility(input_, statistics);
    photons_.learn_sky(input_, statistics);
    return photons_.end_paths(input_, progress_, statistics);
  }

  const RenderInput input_;
  uint64_t shares_;
  std::shared_ptr<FirstPhotons> first_;
  AdaptiveWork adaptive_work_;
  PixelsCallback on_pixels_;
  ProgressCallback progress_;
  PassPhotons photons_;
};

bool has_samples(const FilmSums& film) {
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      if (film.at(x, y).count > 0) return true;
  return false;
}

ExactUnits units_of(const RenderInput& input, uint64_t shares) {
  const PassShare pass = pass_share(0, shares, input.settings.photons, input.settings.spp);
  const bool adaptive = pass_samples(pass, input.settings, input.plan).adaptive_work > 0;
  return choose_units(input.scene, pass.end_sample << (adaptive ? kMostDoublings : 0));
}

PassSums nothing_yet(const RenderInput& input, uint64_t shares, bool with_totals) {
  PassSums sums;
  sums.shares = shares;
  PixelWindow<PixelTotals> zero;
  if (with_totals) zero = make_window<PixelTotals>(input.settings.crop, input.scene.camera);
  sums.totals = FilmTotals(std::move(zero), units_of(input, shares));
  if (keeps_halves(input.settings)) sums.totals.keep_halves();
  if (input.scene.needs.scattering) sums.totals.keep_media();
  return sums;
}

// Adds a pass to the totals; returns how many sums were clamped.
uint64_t add_pass(const PassShare& pass, const PassFilm& film, PassSums* sums) {
  const MediaSums* const media = film.has_media() ? &film.media : nullptr;
  if (film.halved()) return sums->totals.add(film.sums, &film.half, media);
  const bool half = pass_in_half(pass.pass, pass.shares, pass.end_sample - pass.first_sample);
  return half ? sums->totals.add_as_half(film.sums, media) : sums->totals.add(film.sums, nullptr, media);
}

// The passes of a set in ascending order, then nothing.
std::function<std::optional<uint64_t>()> one_by_one(const PassSet& passes) {
  return [left = passes]() mutable -> std::optional<uint64_t> {
    if (left.empty()) return std::nullopt;
    const uint64_t pass = left.first();
    left = left.without(PassSet(pass, pass + 1));
    return pass;
  };
}

// Renders one pass after the other and adds them to result->sums. False when the progress callback cancelled;
// then tiles and result->statistics are those of the unfinished pass. tiles must be zero at first.
// empty_sums(): makes those of no pass.
template <class EmptySums>
bool render_passes(PassRenderer& renderer, const RenderTask& task, const EmptySums& empty_sums,
                   PassFilm* tiles, RenderResult* result) {
  PassSums& sums = result->sums;
  bool first = true;
  const auto has_maps = [&] {
    sums.radii = renderer.radii();
    if (first && task.begun) task.begun(sums);
  };
  for (auto pass = task.next_pass(); pass; pass = task.next_pass(), first = false) {
    if (first && *pass > 0 && !renderer.settle_radii()) return false;
    if (!first) tiles->clear();
    result->statistics = {};
    if (!renderer.render(*pass, has_maps, tiles, &result->statistics)) return false;
    if (task.keep_sums) result->statistics.clamped_sums = add_pass(renderer.share(*pass), *tiles, &sums);
    sums.passes.add(PassSet(*pass, *pass + 1));
    sums.statistics += result->statistics;
    if (task.after_pass && !task.after_pass(sums)) return true;
    if (task.keep_sums && sums.totals.pixels().width() == 0) sums = empty_sums();  // they were moved away
  }
  return true;
}

// Fills the result with the mean of all complete passes, or with the finished tiles of the current pass if
// there are none.
void show(const PassFilm& tiles, bool has_totals, RenderResult* result) {
  PassSums& sums = result->sums;
  const bool complete = !sums.passes.empty();
  if (complete && has_totals) return show_passes(result);
  if (complete) result->statistics = sums.statistics;
  result->film = mean_of(tiles.sums, sums.totals.units(), &result->statistics.clamped_sums,
                         tiles.has_media() ? &tiles.media : nullptr);
  if (complete && tiles.halved()) result->halves = halves_of(tiles.sums, tiles.half, sums.totals.units());
  result->shown = complete ? Shown::kPasses : has_samples(tiles.sums) ? Shown::kTiles : Shown::kNothing;
}

}  // namespace

void show_passes(RenderResult* result) {
  const FilmTotals& totals = result->sums.totals;
  const ErrorMap errors = estimate_errors(totals);
  result->statistics = result->sums.statistics;
  result->film = totals.mean();
  if (totals.has_halves()) result->halves = totals.halves();
  show_errors(errors, &result->film);
  result->error = relative_error(errors, result->sums.passes.count());
  result->shown = Shown::kPasses;
}

std::optional<PassSums> begin_passes(const Scene& scene, const accel::Bvh& bvh,
                                     const RenderSettings& settings, const ProgressCallback& progress) {
  check_settings(settings, scene.camera);
  EstimatorPlan plan = make_plan(settings, scene.needs);
  const uint64_t shares = choose_passes(scene, bvh, settings, &plan);
  const RenderInput input{scene, bvh, settings, plan};
  RenderTask task;
  PassRenderer renderer(input, shares, task, {}, serialised(progress, shares));
  if (!renderer.settle_radii()) return std::nullopt;
  PassSums sums = nothing_yet(input, shares, true);
  sums.radii = renderer.radii();
  return sums;
}

RenderResult render(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                    const ProgressCallback& callback, RenderTask task) {
  check_settings(settings, scene.camera);
  require(task.passes.empty() || settings.passes > 0, "a choice of passes requires the number of passes");
  RenderResult result;
  result.plan = make_plan(settings, scene.needs);
  const uint64_t shares = choose_passes(scene, bvh, settings, &result.plan);
  const RenderInput input{scene, bvh, settings, result.plan, task.views};
  const PassSet goal = task.passes.empty() ? PassSet(0, shares) : task.passes;
  const PassSet missing = goal.without(task.done.passes);
  const bool goes_on = !task.done.passes.empty();
  task.keep_sums |= goes_on || missing.count() != 1 || task.next_pass != nullptr;
  const std::optional<GatherRadii> radii = task.done.radii;
  result.sums = goes_on ? std::move(task.done) : nothing_yet(input, shares, task.keep_sums);
  result.sums.radii = radii;
  require(result.sums.shares == shares && result.sums.totals.units() == units_of(input, shares),
          "the passes rendered before belong to another scene or to other settings");

  require(!task.photons || missing == PassSet(0, 1),
          "photons shot in advance can be used only for a single pass");
  PassRenderer renderer(input, shares, task, result.sums.radii,
                        serialised(callback, goal.end() < kMostPasses ? std::max(shares, goal.end()) : 0));
  PassFilm tiles{make_window<PixelSum>(settings.crop, scene.camera), {}, {}};
  if (scene.needs.scattering) tiles.media = make_window<MediaSum>(settings.crop, scene.camera);
  const bool halved = task.keep_sums ? result.sums.totals.has_halves() : keeps_halves(settings);
  // Several planned passes are halved by passes, which the totals do.
  if (halved && shares == 1) tiles.half = make_window<HalfSum>(settings.crop, scene.camera);
  const auto empty_sums = [&] { return nothing_yet(input, shares, task.keep_sums); };
  if (!task.next_pass) task.next_pass = one_by_one(missing);
  result.cancelled = !render_passes(renderer, task, empty_sums, &tiles, &result);
  show(tiles, task.keep_sums, &result);
  return result;
}

}  // namespace kaustik::render
