#pragma once
// A render in passes: each shoots its own photons and takes its own samples of every pixel, and the image is
// the mean over all samples. The estimate is linear in the photons, so P passes of N/P photons, read with the
// radius of N, estimate what one of N does, and need the memory of one.
//
// Passes are equal and independent: what pass i does is a function of (seed, i, photons per pass, samples per
// pass), its radius one of i and of r0. So a render can be split, merged, resumed and extended.

#include <cstdint>

#include "accel/bvh.h"
#include "photon/trace/tracer.h"
#include "render/settings.h"

namespace kaustik::render {

// What one pass does: samples [first_sample, end_sample) of each pixel, and so many photons.
struct PassShare {
  uint64_t pass = 0;    // index: any, also beyond `shares`
  uint64_t shares = 1;  // passes that make up the settings' photons and samples
  uint64_t photons = 0;
  uint64_t first_sample = 0, end_sample = 0;
};

// Each pass has photons / shares photons and spp / shares samples, rounded up: all `shares` together have at
// least what was asked for.
PassShare pass_share(uint64_t pass, uint64_t shares, uint64_t photons, int spp);

// Numbers of the camera samples of a pass, of each pixel.
struct PassSamples {
  uint64_t first = 0, end = 0;
  // Others follow from `end` on where the first differ most, for at most so much of their work; 0: none.
  double further_work = 0;
};

// Further samples are taken where settings.adaptive says so and one pass holds all, with which they are
// stratified; another pass with as many, beyond those of the settings, has strata of its own
// (core/sampling/sampler.h). Of several passes the samples of all together are stratified, which further ones
// of each would spoil. Paths from the camera have none: the few that bring most of their light are seldom
// among the first.
PassSamples pass_samples(const PassShare& pass, const RenderSettings& settings, const EstimatorPlan& plan);

// Gather radii r0 of the first pass, metres; 0 for maps that are not read.
struct GatherRadii {
  float direct = 0, caustic = 0, indirect = 0;
  // Of the photons of all passes the so-manieth to which the caustic map's radius shrinks, where nobody gave
  // a radius; 0: it does not.
  uint32_t caustic_nearest = 0;
  bool operator==(const GatherRadii&) const = default;
};

// r_i^2 / r_1^2 of pass i = pass + 1 under r_{i+1}^2 = r_i^2 (i + alpha) / (i + 1) (Knaus and Zwicker 2011,
// "Progressive Photon Mapping: A Probabilistic Approach"). With alpha in (0, 1) bias and variance of
// the mean over passes both vanish, the bias like pass^(alpha - 1); alpha = 1 is 1: a fixed radius. Basic
// arithmetic only, so that it is the same number everywhere; takes `pass` steps.
double radius_shrink_squared(uint64_t pass, float alpha);

// The same for one pass after the other: a step each.
class RadiusShrink {
 public:
  double squared(uint64_t pass, float alpha);

 private:
  uint64_t pass_ = 0;
  float alpha_ = 1;
  double squared_ = 1;
};

// What the tracer is told for a pass. Only the kinds that the plan reads are traced.
photon::TraceSettings trace_settings(const RenderSettings& settings, const EstimatorPlan& plan,
                                     const PassShare& pass);

// settings.passes, or as many as it takes for the photons of each to fit into settings.photon_memory, which
// adds a note to the plan when it is more than one. Then the image depends on that memory, but for noise
// only; settings.passes makes it independent. Throws std::invalid_argument for more passes than photons,
// std::runtime_error when the photons of one would not fit, or would only in 2^31 passes or more.
uint64_t choose_passes(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                       EstimatorPlan* plan);

}  // namespace kaustik::render
