#pragma once
// Division of a render into passes: each shoots its own photons and takes its own samples of every pixel, and
// the image is the mean over all samples. The estimate is linear in the photons, so P passes of N/P photons,
// gathered with the radius of N, estimate the same as one pass of N photons, with the memory of one pass.
//
// Passes are equal and independent: what pass i computes is a function of (seed, i, photons per pass, samples
// per pass) and r0, and its radius a function of i and r0. So a render can be split, merged, resumed and
// extended.

#include <cstdint>

#include "accel/bvh.h"
#include "photon/trace/tracer.h"
#include "render/settings.h"

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
  double further_work = 0;
};

// Adaptive samples are taken if settings.adaptive says so and one pass takes all samples, with which they are
// then stratified; a further pass beyond those of the settings has strata of its own
// (core/sampling/sampler.h). With several passes, the samples of all passes are stratified together, which
// adaptive samples would spoil. Path tracing from the camera does not use them: the few paths that bring most
// of its light are seldom among the first.
PassSamples pass_samples(const PassShare& pass, const RenderSettings& settings, const EstimatorPlan& plan);

// Gather radii r0 of the first pass, in metres; 0 for maps that are not used.
struct GatherRadii {
  float direct = 0, caustic = 0, indirect = 0;
  // If > 0, the caustic map's radius shrinks to the k-th nearest photon, with k counted over all passes. Set
  // where the user gave neither a radius nor --nearest.
  uint32_t caustic_nearest = 0;
  bool operator==(const GatherRadii&) const = default;
};

// r_i^2 / r_1^2 for pass i = pass + 1 under r_{i+1}^2 = r_i^2 (i + alpha) / (i + 1) (Knaus and Zwicker 2011,
// "Progressive Photon Mapping: A Probabilistic Approach"). For alpha in (0, 1), bias and variance of the mean
// over passes both vanish, the bias like pass^(alpha - 1); alpha = 1 gives 1, a fixed radius. Uses basic
// arithmetic only, so the result is the same on every machine. Takes `pass` steps.
double radius_shrink_squared(uint64_t pass, float alpha);

// Computes the same for successive passes, with one step each.
class RadiusShrink {
 public:
  double squared(uint64_t pass, float alpha);

 private:
  uint64_t pass_ = 0;
  float alpha_ = 1;
  double squared_ = 1;
};

// The tracer's settings for a pass. Only the kinds that the plan needs are traced.
photon::TraceSettings trace_settings(const RenderSettings& settings, const EstimatorPlan& plan,
                                     const PassShare& pass);

// Returns settings.passes if set; otherwise as many passes as are needed for the photons of each to fit into
// settings.photon_memory, and if there are several, adds a note to the plan. The image then depends on that
// memory, though only in its noise; settings.passes makes it independent. Throws std::invalid_argument for
// more passes than photons, and std::runtime_error if the photons of one pass would not fit, or only with
// 2^31 passes or more.
uint64_t choose_passes(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                       EstimatorPlan* plan);

}  // namespace kaustik::render
