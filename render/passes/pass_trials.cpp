// Times trial shoots and trial windows, and fits the cost of photons and samples.

#include "render/passes/pass_trials.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/sampling/sampler.h"
#include "core/stopwatch.h"
#include "render/camera/camera_rays.h"
#include "render/camera/pixel_range.h"
#include "render/camera/ray_cone.h"
#include "render/tiles/tiles.h"

namespace kaustik::render {

namespace {

// Two trial shoots fit a line to the cost per photon. Including the learning of guides, it predicted up to
// four million photons within a third on every scene measured.
constexpr uint64_t kFewPhotons = 1u << 14, kMorePhotons = 1u << 16;
// Side of a trial window in pixels: a few blocks of rays, which share gathers. This many windows sample the
// parts of a picture well enough.
constexpr int kWindow = 3 * kRayBlock;
constexpr double kFewWindows = 36, kManyWindows = 120;
constexpr double kShare = 1.0 / 16;  // of the picture's pixels, within these limits

// Windows at hashed positions, one in each cell of a regular grid over the picture.
std::vector<PixelRange> windows_of(const PixelRange& whole) {
  const double wanted =
      std::clamp(double(whole.pixels()) * kShare / (kWindow * kWindow), kFewWindows, kManyWindows);
  const int places = std::max(1, int(std::sqrt(double(whole.pixels()) / wanted) / kWindow));
  std::vector<PixelRange> windows;
  whole.for_each_square(kWindow * places, [&](const PixelRange& square) {
    const uint64_t place = hash_combine(uint64_t(square.x0), uint64_t(square.y0));
    const auto at = [&](int corner, uint64_t number) {
      return corner - corner % (kWindow * places) + kWindow * int(number % uint64_t(places));
    };
    const PixelRange window = square.in_square(at(square.x0, place), at(square.y0, place >> 32), kWindow);
    if (window.x0 < window.x1 && window.y0 < window.y1) windows.push_back(window);
  });
  if (windows.empty()) windows.push_back(whole.in_square(whole.x0, whole.y0, kWindow));
  return windows;
}

// Seconds for the samples of all pixels, extrapolated from those of the windows.
double seconds_of(const RenderInput& input, const PassPhotons& photons,
                  const std::vector<PixelRange>& windows) {
  const Stopwatch watch;
  const RenderSettings& settings = input.settings;
  const Camera& camera = input.scene.camera;
  const PassShare pass = pass_share(0, 1, settings.photons, settings.spp);
  const RenderContext ctx{input,
                          photons.maps(),
                          photons.visibility(),
                          photons.sky(),
                          pass,
                          pass_samples(pass, settings, input.plan),
                          camera_cone(camera, pass.end_sample)};
  tbb::parallel_for(size_t(0), windows.size(), [&](size_t i) {
    const PixelRange& w = windows[i];
    FilmSums film(w.width(), w.height(), w.x0, w.y0, camera.width, camera.height);
    RenderStatistics ignored;
    render_tiles(ctx, {}, &film, &ignored);
  });
  const double seconds = watch.seconds();
  uint64_t pixels = 0;
  for (const PixelRange& w : windows) pixels += w.pixels();
  return seconds * double(rendered_range(settings.crop, camera).pixels()) / double(pixels);
}

}  // namespace

FirstPhotons shoot_first(const RenderInput& input, const ProgressCallback& progress) {
  FirstPhotons first;
  first.photons.make(input, pass_share(0, 1, input.settings.photons, 1), progress, &first.statistics);
  return first;
}

PhotonCost photon_cost(double few, double more) {
  const double slope = (more - few) / double(kMorePhotons - kFewPhotons);
  PhotonCost cost;
  cost.each = std::max(slope, more / double(2 * kMorePhotons));
  cost.fixed = std::max(few - double(kFewPhotons) * cost.each, 0.0);
  return cost;
}

PhotonTrial try_photons(const RenderInput& input, double most, const ProgressCallback& progress) {
  PhotonTrial trial;
  const auto shoot = [&](uint64_t photons) {
    const Stopwatch watch;
    RenderSettings few = input.settings;
    few.photons = photons;
    trial.first = shoot_first({input.scene, input.bvh, few, input.plan}, progress);
    return watch.seconds();
  };
  const double few = shoot(kFewPhotons);
  trial.cost = few < most ? photon_cost(few, shoot(kMorePhotons)) : PhotonCost{0, few / double(kFewPhotons)};
  return trial;
}

SampleCost sample_cost(double one, double four, double four_further, double adaptive) {
  SampleCost cost;
  if (adaptive > 0) cost.further = std::max((four_further - four) / (4 * adaptive), 0.0);
  const double alone = one - adaptive * cost.further;  // cost of one sample without further ones
  cost.each = std::max((four - alone) / 3, four / 8);
  cost.fixed = std::max(alone - cost.each, 0.0);
  return cost;
}

SampleCost try_samples(const RenderInput& input, double most, PassPhotons* photons) {
  if (!photons->radii()) return {.each = 1};  // cancelled
  const RenderSettings& settings = input.settings;
  const std::vector<PixelRange> windows = windows_of(rendered_range(settings.crop, input.scene.camera));
  RenderStatistics ignored;
  photons->predict_visibility(input, &ignored);
  photons->learn_sky(input, &ignored);
  const auto seconds = [&](int spp, float adaptive) {
    RenderSettings tried = settings;
    tried.spp = spp, tried.adaptive = adaptive;
    return seconds_of({input.scene, input.bvh, tried, input.plan}, *photons, windows);
  };
  const Stopwatch watch;
  const float w = settings.adaptive;
  const double one = seconds(1, w);
  SampleCost cost{0, one / (1 + double(w)), w > 0 ? one / (1 + double(w)) : 0};
  if (watch.seconds() < most) {
    const double four = seconds(4, 0);
    cost = sample_cost(one, four, w > 0 ? seconds(4, w) : four, double(w));
  }
  photons->forget_visibility();  // it depends on settings.spp
  return cost;
}

}  // namespace kaustik::render
