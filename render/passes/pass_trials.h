#pragma once
// Measures the cost of a pass on this machine by trials: with few photons, and with few samples in windows
// spread over the picture. All functions run within the render's task arena.

#include <algorithm>

#include "render/maps/pass_photons.h"

namespace kaustik::render {

// Wall-clock seconds of the photons of a pass.
struct PhotonCost {
  double fixed = 0, each = 0;  // each > 0
  double photons = 0;          // of the larger trial, whose maps are left
  // Stored for each emitted photon, but never 0; guided emission may store several.
  double stored_caustic = 0, stored_indirect = 0;
};

// Wall-clock seconds of the samples of every pixel: of(spp, adaptive) for spp samples and adaptive ones that
// take `adaptive` times their work (RenderSettings::adaptive).
struct SampleCost {
  double fixed = 0, each = 0, each_adaptive = 0;
  double of(double spp, double adaptive) const { return fixed + spp * (each + adaptive * each_adaptive); }
};

// Fits a line to the measured seconds of one sample with adaptive ones, of four samples without and of four
// with them. A slope below half of the larger trial's mean cost is attributed to noise and raised to it.
SampleCost sample_cost(double one, double four, double four_adaptive, double adaptive);

struct PhotonTrial {
  PhotonCost cost;
  FirstPhotons first;
};

// Explores the scene, shoots a few photons, and more of them if that took less than `most` seconds. explored:
// what earlier photons of the same scene found out about it.
PhotonTrial try_photons(const RenderInput& input, double most, const ProgressCallback& progress,
                        std::shared_ptr<ExploredScene> explored = std::make_shared<ExploredScene>());

// Shoots the photons of a render that has a single pass. They have no radii if the progress callback
// cancelled. What exploring the scene took before counts in their seconds.
FirstPhotons shoot_first(const RenderInput& input, const ProgressCallback& progress,
                         const std::shared_ptr<ExploredScene>& explored = std::make_shared<ExploredScene>());

// Where the error of a picture comes from, as means over its pixels relative to the square of their luminance
// (to which the square of a tenth of the picture's mean is added).
struct ErrorSources {
  double samples = 0;                // variance of one sample, given the photons
  double caustic = 0, indirect = 0;  // square of the light that these photon maps give
};

// Mean luminances of a pixel by either half of the samples of a trial; their difference is noise.
struct PixelHalves {
  struct Pair {
    double first = 0, second = 0;
    double mean() const { return (first + second) / 2; }
    double error() const { return (first - second) / 2; }  // one observation of the error of mean()
  };
  Pair all, caustic, indirect;
};

struct SampleTrial {
  double seconds = 0;  // for one sample of every pixel, where there are few
  ErrorSources errors;
  std::vector<std::vector<PixelHalves>> blocks;  // pixels of the same blocks in each trial, perhaps of fewer
};
// Renders a few samples in windows with these photons, no further windows once `most` seconds have passed.
// The tree of predicted visibility, which depends on settings.spp, stays with the photons.
SampleTrial try_one_sample(const RenderInput& input, double most, PassPhotons* photons);

// Renders one sample and four, without and with adaptive ones, with these photons in as many windows as take
// about `most` seconds, at least a few. Without photons (cancelled) the result is meaningless.
SampleCost try_samples(const RenderInput& input, double most, PassPhotons* photons);

}  // namespace kaustik::render
