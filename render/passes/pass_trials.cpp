// Times trial shoots and trial windows, and fits the cost of photons and samples.

#include "render/passes/pass_trials.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/parallel/parallel.h"
#include "core/sampling/sampler.h"
#include "core/stopwatch.h"
#include "render/camera/camera_rays.h"
#include "render/camera/pixel_range.h"
#include "render/camera/ray_cone.h"
#include "render/tiles/tiles.h"

namespace kaustik::render {

namespace {

// The first trial shoot learns the guides, too, and the second one tells what a photon takes without that.
constexpr uint64_t kFewPhotons = 1u << 14, kMorePhotons = 1u << 16;
// Side of a trial window in pixels: a few blocks of rays, which share gathers.
constexpr int kWindow = 3 * kRayBlock;
// Samples of each pixel in a trial that measures errors.
constexpr int kTrialSamples = 4;
// This many windows sample the parts of a picture well enough.
constexpr double kFewWindows = 36, kManyWindows = 120;
constexpr double kShare = 1.0 / 16;  // of the picture's pixels, within these limits

// Side of a square cell in pixels, a multiple of a block's, such that about this many cover the picture.
int cell_side(const PixelRange& whole, double wanted) {
  const double side = std::sqrt(double(whole.pixels()) / wanted);
  return std::max(kWindow, kRayBlock * int(std::ceil(side / kRayBlock)));
}

// Windows at hashed positions, one in each cell of a regular grid over the picture.
std::vector<PixelRange> windows_of(const PixelRange& whole) {
  const double wanted =
      std::clamp(double(whole.pixels()) * kShare / (kWindow * kWindow), kFewWindows, kManyWindows);
  const int cell = cell_side(whole, wanted);
  const auto places = uint64_t((cell - kWindow) / kRayBlock + 1);
  std::vector<PixelRange> windows;
  whole.for_each_square(cell, [&](const PixelRange& square) {
    const uint64_t place = hash_combine(uint64_t(square.x0), uint64_t(square.y0));
    const auto at = [&](int corner, uint64_t number) {
      return corner - corner % cell + kRayBlock * int(number % places);
    };
    const PixelRange window = square.in_square(at(square.x0, place), at(square.y0, place >> 32), kWindow);
    if (window.x0 < window.x1 && window.y0 < window.y1) windows.push_back(window);
  });
  if (windows.empty()) windows.push_back(whole.in_square(whole.x0, whole.y0, kWindow));
  return windows;
}

size_t tiles_of(const PixelRange& range) {
  size_t tiles = 0;
  range.for_each_square(kTileSize, [&](const PixelRange&) { ++tiles; });
  return tiles;
}

// Renders trial windows and extrapolates to the picture.
class WindowTrials {
 public:
  WindowTrials(const RenderInput& input, const PassPhotons& photons)
      : input_(input),
        photons_(photons),
        whole_(rendered_range(input.settings.crop, input.scene.camera)),
        windows_(windows_of(whole_)) {
    // Neighbouring windows are alike, and a trial that is cut short should still see all of the picture.
    std::ranges::stable_sort(windows_, std::less<>(), [](const PixelRange& w) {
      return hash_combine(uint64_t(w.x0) << 32 | uint64_t(w.y0), kWindowOrder);
    });
  }

  // Seconds for these samples of all pixels. Renders no further windows once `most` seconds have passed; the
  // trials that follow take the same windows.
  double seconds(int spp, float adaptive, double most = kInfinity) {
    RenderSettings tried = input_.settings;
    tried.spp = spp, tried.adaptive = adaptive;
    const PassShare pass = pass_share(0, 1, tried.photons, spp);
    return seconds(tried, pass_samples(pass, tried, input_.plan), most);
  }

  // Seconds for kInHalf samples of all pixels, from number `first` on, whose sums take_films() then gives.
  static constexpr uint64_t kInHalf = kTrialSamples / 2;
  double seconds_of_half(uint64_t first, double most = kInfinity) {
    RenderSettings tried = input_.settings;
    tried.spp = 2 * kInHalf;
    return seconds(tried, {first, first + kInHalf, 0}, most);
  }
  std::vector<FilmSums> take_films() { return std::move(films_); }

 private:
  static constexpr uint64_t kWindowOrder = 0x717A15;

  double seconds(const RenderSettings& tried, const PassSamples& samples, double most) {
    const RenderInput input{input_.scene, input_.bvh, tried, input_.plan};
    const auto threads = size_t(tbb::this_task_arena::max_concurrency());
    const size_t together = 2 * threads;
    films_.assign(windows_.size(), {});
    std::vector<double> took(windows_.size());
    const Stopwatch watch;
    size_t done = 0;
    while (done < windows_.size() && (done == 0 || watch.seconds() < most)) {
      const size_t end = std::min(windows_.size(), done + together);
      parallel::for_index(done, end, [&](size_t i) {
        const Stopwatch of_window;
        // Isolated, since a thread that waits within a window could render another one meanwhile.
        tbb::this_task_arena::isolate([&] { films_[i] = render(input, samples, windows_[i]); });
        took[i] = of_window.seconds();
      });
      done = end;
    }
    // Threads that wait for the last of a few windows would not do so in a whole picture of enough tiles.
    const double seconds =
        std::reduce(took.begin(), took.end()) / double(std::min(threads, tiles_of(whole_)));
    windows_.resize(done);
    films_.resize(done);
    uint64_t pixels = 0;
    for (const PixelRange& w : windows_) pixels += w.pixels();
    return seconds * double(whole_.pixels()) / double(pixels);
  }

  FilmSums render(const RenderInput& input, const PassSamples& samples, const PixelRange& w) const {
    const Camera& camera = input.scene.camera;
    const PassShare pass = pass_share(0, 1, input.settings.photons, input.settings.spp);
    const RenderContext ctx{input,
                            photons_.maps(),
                            photons_.visibility(),
                            photons_.sky(),
                            pass,
                            samples,
                            camera_cone(camera, pass.end_sample)};
    RenderStatistics ignored;
    PassFilm film{FilmSums(w.width(), w.height(), w.x0, w.y0, camera.width, camera.height), {}, {}};
    render_tiles(ctx, {}, &film, &ignored);
    return std::move(film.sums);
  }

  const RenderInput& input_;
  const PassPhotons& photons_;
  PixelRange whole_;
  std::vector<PixelRange> windows_;
  std::vector<FilmSums> films_;  // of the last trial
};

double luminance_of(const glm::dvec3& c) {
  return double(luminance(Rgb(c)));
}

PixelHalves halves_of(const PixelSum& a, const PixelSum& b) {
  const auto pair = [](const glm::dvec3& first, const glm::dvec3& second) {
    constexpr double kHalf = WindowTrials::kInHalf;
    return PixelHalves::Pair{luminance_of(first) / kHalf, luminance_of(second) / kHalf};
  };
  const auto all = [](const PixelSum& p) { return p.emitted + p.direct + p.caustic + p.indirect; };
  return {pair(all(a), all(b)), pair(a.caustic, b.caustic), pair(a.indirect, b.indirect)};
}

// The blocks of rays of a window.
void add_blocks(const FilmSums& first, const FilmSums& second,
                std::vector<std::vector<PixelHalves>>* blocks) {
  // Blocks are counted from the corner of the full image.
  const int x0 = first.x0(), y0 = first.y0();
  const PixelRange window{x0, x0 + first.width(), y0, y0 + first.height()};
  window.for_each_square(kRayBlock, [&](const PixelRange& square) {
    std::vector<PixelHalves>& block = blocks->emplace_back();
    for (int y = square.y0; y < square.y1; ++y)
      for (int x = square.x0; x < square.x1; ++x)
        block.push_back(halves_of(first.at(x - x0, y - y0), second.at(x - x0, y - y0)));
  });
}

// The unit of relative squares, for light of this luminance in a picture of this mean.
double relative_unit(double light, double mean) {
  return light * light + 0.01 * mean * mean;
}

// What two halves of the samples say: the difference of independent estimates is their noise.
ErrorSources error_sources(const EstimatorPlan& plan, const std::vector<std::vector<PixelHalves>>& blocks) {
  double mean = 0, count = 0;
  for (const auto& block : blocks)
    for (const PixelHalves& p : block) mean += p.all.mean(), ++count;
  mean /= std::max(count, 1.0);
  ErrorSources sum;
  for (const auto& block : blocks)
    for (const PixelHalves& p : block) {
      constexpr double kMostOfPixel = 16;  // so that a bright pixel does not decide alone
      const double unit = relative_unit(p.all.mean(), mean);
      if (!(unit > 0)) continue;
      // The mean of n samples has an nth of the variance of one.
      const double variance = p.all.error() * p.all.error() * kTrialSamples;
      const double caustic = reads_caustic_photons(plan) ? p.caustic.mean() : 0;
      const double indirect = reads_indirect_photons(plan) ? p.indirect.mean() : 0;
      sum.samples += std::min(variance / unit, kMostOfPixel) / count;
      sum.caustic += caustic * caustic / unit / count;
      sum.indirect += indirect * indirect / unit / count;
    }
  return sum;
}

}  // namespace

FirstPhotons shoot_first(const RenderInput& input, const ProgressCallback& progress,
                         const std::shared_ptr<ExploredScene>& explored) {
  FirstPhotons first{PassPhotons(explored), {}};
  first.statistics.photon_build_s = explored->seconds;
  first.photons.make(input, pass_share(0, 1, input.settings.photons, 1), progress, &first.statistics);
  return first;
}

PhotonTrial try_photons(const RenderInput& input, double most, const ProgressCallback& progress,
                        std::shared_ptr<ExploredScene> explored) {
  PhotonTrial trial;
  trial.first.photons = PassPhotons(std::move(explored));
  PassPhotons& photons = trial.first.photons;
  photons.mark_as_trial();
  photons.explore(input, progress);
  const auto shoot = [&](uint64_t count) {
    const Stopwatch watch;
    RenderSettings few = input.settings;
    few.photons = count;
    photons.make({input.scene, input.bvh, few, input.plan}, pass_share(0, 1, count, 1), progress,
                 &trial.first.statistics);
    return watch.seconds();
  };
  const double first = shoot(kFewPhotons);
  const uint64_t more = first < most ? kMorePhotons : kFewPhotons;
  const double each = shoot(more) / double(more);
  // Not timed: the fixed cost, from the first shoot, already includes the choice of radii.
  if (more > kFewPhotons) photons.choose_radii_anew(input, pass_share(0, 1, more, 1));
  const auto stored = [&](const GatherMap& of) { return double(of.map.size() + 1) / double(more); };
  trial.cost = {std::max(first - each * double(kFewPhotons), 0.0), each, double(more),
                stored(photons.maps().caustic), stored(photons.maps().indirect)};
  return trial;
}

SampleCost sample_cost(double one, double four, double four_adaptive, double adaptive) {
  SampleCost cost;
  if (adaptive > 0) cost.each_adaptive = std::max((four_adaptive - four) / (4 * adaptive), 0.0);
  const double alone = one - adaptive * cost.each_adaptive;  // cost of one sample without adaptive ones
  cost.each = std::max((four - alone) / 3, four / 8);
  cost.fixed = std::max(alone - cost.each, 0.0);
  return cost;
}

namespace {

void learn_for_samples(const RenderInput& input, PassPhotons* photons) {
  RenderStatistics ignored;
  photons->predict_visibility(input, &ignored);
  photons->learn_sky(input, &ignored);
}

}  // namespace

SampleTrial try_one_sample(const RenderInput& input, double most, PassPhotons* photons) {
  constexpr double kHalf = WindowTrials::kInHalf;
  learn_for_samples(input, photons);
  WindowTrials trials(input, *photons);
  const double first_seconds = trials.seconds_of_half(0, most / 2);
  std::vector<FilmSums> first = trials.take_films();
  SampleTrial trial;
  trial.seconds = (first_seconds + trials.seconds_of_half(WindowTrials::kInHalf)) / (2 * kHalf);
  const std::vector<FilmSums> second = trials.take_films();
  for (size_t i = 0; i < first.size(); ++i) add_blocks(first[i], second[i], &trial.blocks);
  trial.errors = error_sources(input.plan, trial.blocks);
  if (const LearnedSplit* split = photons->maps().split) {
    // Only what photons bring has their error.
    const double squared = split->light * split->light;
    trial.errors.caustic *= squared, trial.errors.indirect *= squared;
  }
  return trial;
}

SampleCost try_samples(const RenderInput& input, double most, PassPhotons* photons) {
  if (!photons->radii() && kinds_needed(input.plan).any()) return {.each = 1};  // cancelled
  learn_for_samples(input, photons);
  const float w = input.settings.adaptive;
  // The three trials of a window together take about this many times as long as the first.
  const double all = 1 + 4 / (1 + double(w)) + 4;
  WindowTrials trials(input, *photons);
  const double one = trials.seconds(1, w, most / all);
  const double four = trials.seconds(4, 0);
  const SampleCost cost = sample_cost(one, four, w > 0 ? trials.seconds(4, w) : four, double(w));
  photons->forget_visibility();  // it depends on settings.spp
  return cost;
}

}  // namespace kaustik::render
