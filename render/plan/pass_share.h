#pragma once
// Division of a render into passes: each shoots its own photons and takes its own samples of every pixel, and
// the image is the mean over all samples. The estimate is linear in the photons, so P passes of N/P photons,
// gathered with the radius of N, estimate the same as one pass of N photons, with the memory of one pass.
//
// Passes are equal and independent: what pass i computes is a function of (seed, i, photons per pass, samples
// per pass) and r0, and its radius a function of i and r0. So a render can be split, merged, resumed and
// extended.

#include <cstdint>

#include "render/plan/plan.h"

namespace kaustik::render {

// Work of one pass: samples [first_sample, end_sample) of each pixel, and a number of photons.
struct PassShare {
  uint64_t pass = 0;    // index of the pass, which may exceed `shares`
  uint64_t shares = 1;  // number of passes among which the settings' photons and samples are divided
  uint64_t photons = 0;
  uint64_t first_sample = 0, end_sample = 0;
};

// Each pass has photons / shares photons and spp / shares samples, rounded up, so that all `shares` passes
// together have at least the requested number.
PassShare pass_share(uint64_t pass, uint64_t shares, uint64_t photons, int spp);

// Indices of a pass's camera samples, for each pixel.
struct PassSamples {
  uint64_t first = 0, end = 0;
  // Adaptive samples follow from index `end` on; their work is at most this multiple of that of the first. 0:
  // none.
  double adaptive_work = 0;
};

// Adaptive samples are taken if settings.adaptive says so and one pass takes all samples, with which they are
// then stratified; a further pass beyond those of the settings has strata of its own
// (core/sampling/sampler.h). With several passes, the samples of all passes are stratified together, which
// adaptive samples would spoil. Path tracing from the camera does not use them: the few paths that bring most
// of its light are seldom among the first.
PassSamples pass_samples(const PassShare& pass, const RenderSettings& settings, const EstimatorPlan& plan);

}  // namespace kaustik::render
