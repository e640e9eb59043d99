#pragma once
// Measures the cost of a pass on this machine by trials: with few photons, and with few samples in windows
// spread over the picture. All functions run within the render's task arena.

#include <algorithm>

#include "render/maps/pass_photons.h"

namespace kaustik::render {

// Wall-clock seconds of the photons of a pass, with what they learn before, such as guides.
struct PhotonCost {
  double fixed = 0, each = 0;  // each > 0
  double photons = 0;          // of the larger trial, whose maps are left
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
                        const std::shared_ptr<ExploredScene>& explored = std::make_shared<ExploredScene>());

// Shoots the photons of a render that has a single pass. They have no radii if the progress callback
// cancelled. What exploring the scene took before counts in their seconds.
FirstPhotons shoot_first(const RenderInput& input, const ProgressCallback& progress,
                         const std::shared_ptr<ExploredScene>& explored = std::make_shared<ExploredScene>());

// Renders a few samples in windows with these photons, no further windows once `most` seconds have passed.
// Returns the seconds for one sample of every pixel, where there are several. The tree of predicted
// visibility, which depends on settings.spp, stays with the photons.
double try_one_sample(const RenderInput& input, double most, PassPhotons* photons);

// Renders one sample and four, without and with adaptive ones, with these photons in as many windows as take
// about `most` seconds, at least a few. Without photons (cancelled) the result is meaningless.
SampleCost try_samples(const RenderInput& input, double most, PassPhotons* photons);

}  // namespace kaustik::render
