#pragma once
// A render in passes: each shoots its own photons and takes its own share of every pixel's samples, and the
// image is the mean over all samples. The estimate is linear in the photons, so P passes of N/P photons, read
// with the radius of N, estimate what one of N does, and need the memory of one.

#include <cstdint>

#include "accel/bvh.h"
#include "photon/tracer.h"
#include "render/settings.h"

namespace kaustik::render {

// What one pass does: samples [first_sample, end_sample) of each pixel, and `photons` of the render's
// photons.
struct PassRange {
  uint64_t pass = 0, passes = 1;
  uint64_t photons = 0;
  int first_sample = 0, end_sample = 0;
};

// Pass `pass` of `passes`: samples and photons are shared out as evenly as whole numbers allow. With fewer
// samples than passes, each pass takes one.
PassRange pass_range(uint64_t pass, uint64_t passes, uint64_t photons, int spp);

// What the tracer is told for a pass. Only the kinds that the plan reads are traced.
photon::TraceSettings trace_settings(const RenderSettings& settings, const EstimatorPlan& plan,
                                     const PassRange& pass);

// settings.passes, or as many as it takes for the photons of each to fit into settings.photon_memory, which
// adds a note to the plan when it is more than one. Then the image depends on that memory, but for noise
// only; settings.passes makes it independent. Throws std::invalid_argument for more passes than photons,
// std::runtime_error when the photons of one would not fit, or would only in 2^31 passes or more.
uint64_t choose_passes(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                       EstimatorPlan* plan);

}  // namespace kaustik::render
