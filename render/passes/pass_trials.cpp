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

// The first trial shoot learns the guides, too. The second one tells what a photon takes without that, or,
// where the first one has found few useful photons, what learning from more of them takes.
constexpr uint64_t kFewPhotons = 1u << 14, kMorePhotons = 1u << 16;
// Guides that have learned from so many useful photons hardly take longer with more of them.
constexpr uint64_t kManyHits = 1u << 11;
// Side of a trial window in pixels: a few blocks of rays, which share gathers.
constexpr int kWindow = 3 * kRayBlock;
// Samples of each pixel that share gathers in a trial, as those of a render do.
constexpr int kSamplesTogether = 8;
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
    const RenderInput input{input_.scene, input_.bvh, tried, input_.plan};
    const auto threads = size_t(tbb::this_task_arena::max_concurrency());
    const size_t together = 2 * threads;
    std::vector<double> took(windows_.size());
    const Stopwatch watch;
    size_t done = 0;
    while (done < windows_.size() && (done == 0 || watch.seconds() < most)) {
      const size_t end = std::min(windows_.size(), done + together);
      parallel::for_index(done, end, [&](size_t i) {
        const Stopwatch of_window;
        // Isolated, since a thread that waits within a window could render another one meanwhile.
        tbb::this_task_arena::isolate([&] { render(input, windows_[i]); });
        took[i] = of_window.seconds();
      });
      done = end;
    }
    // Threads that wait for the last of a few windows would not do so in a whole picture of enough tiles.
    const double seconds =
        std::reduce(took.begin(), took.end()) / double(std::min(threads, tiles_of(whole_)));
    windows_.resize(done);
    uint64_t pixels = 0;
    for (const PixelRange& w : windows_) pixels += w.pixels();
    return seconds * double(whole_.pixels()) / double(pixels);
  }

 private:
  static constexpr uint64_t kWindowOrder = 0x717A15;

  void render(const RenderInput& input, const PixelRange& w) const {
    const Camera& camera = input.scene.camera;
    const PassShare pass = pass_share(0, 1, input.settings.photons, input.settings.spp);
    const RenderContext ctx{input,
                            photons_.maps(),
                            photons_.visibility(),
                            photons_.sky(),
                            pass,
                            pass_samples(pass, input.settings, input.plan),
                            camera_cone(camera, pass.end_sample)};
    RenderStatistics ignored;
    PassFilm film{FilmSums(w.width(), w.height(), w.x0, w.y0, camera.width, camera.height), {}, {}};
    render_tiles(ctx, {}, &film, &ignored);
  }

  const RenderInput& input_;
  const PassPhotons& photons_;
  PixelRange whole_;
  std::vector<PixelRange> windows_;
};

// From the seconds of both shoots. learned: the second one has learned anew what guides its photons.
PhotonCost cost_of_trials(double first, double second, bool learned) {
  constexpr auto kFew = double(kFewPhotons), kMore = double(kMorePhotons);
  const double each =
      learned ? std::max((second - first) / (kMore - kFew), second / (2 * kMore)) : second / kMore;
  return {.fixed = std::max(first - each * kFew, 0.0), .each = each, .photons = kMore};
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
                        const std::shared_ptr<ExploredScene>& explored) {
  PhotonTrial trial;
  PassPhotons& photons = trial.first.photons;
  const auto begin = [&] {
    photons = PassPhotons(explored);
    photons.mark_as_trial();
    photons.explore(input, progress);
  };
  const auto shoot = [&](uint64_t count) {
    const Stopwatch watch;
    RenderSettings few = input.settings;
    few.photons = count;
    photons.make({input.scene, input.bvh, few, input.plan}, pass_share(0, 1, count, 1), progress,
                 &trial.first.statistics);
    return watch.seconds();
  };
  begin();
  const double first = shoot(kFewPhotons);
  trial.cost = {.each = first / double(kFewPhotons), .photons = double(kFewPhotons)};
  if (!(first < most)) return trial;
  const bool learn_again = trial.first.statistics.guide_hits < kManyHits;
  if (learn_again) begin();
  const double second = shoot(kMorePhotons);
  trial.cost = cost_of_trials(first, second, learn_again);
  // Not timed: the fixed cost, from the first shoot, already includes the choice of radii.
  if (!learn_again) photons.choose_radii_anew(input, pass_share(0, 1, kMorePhotons, 1));
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

double try_one_sample(const RenderInput& input, double most, PassPhotons* photons) {
  learn_for_samples(input, photons);
  return WindowTrials(input, *photons).seconds(kSamplesTogether, 0, most) / kSamplesTogether;
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
