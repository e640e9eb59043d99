#pragma once
// The radiance of one camera ray: the rendering equation, split by classes of paths.

#include "photon/estimate/estimate_batch.h"
#include "render/render_context.h"

namespace kaustik::render {

// One sample of a pixel: its camera ray, and what that meets.
struct CameraSample {
  Ray ray;
  Hit hit;
  bool with_bias = false;                  // the kernels' bias too, which takes a second, smaller gather
  photon::EstimateBatch* batch = nullptr;  // where estimates may wait
  SampleLight light = SampleLight::kAll;   // traced light alone needs a plan without camera paths
};

// Adds the sample to *result, which was empty; what waits in the batch is added when that is flushed.
// Radiance by class in W/(m^2 sr); albedo, normal and depth of the first hit; photons in reach of the
// queries. Draws from `sampler` what it needs.
void trace_camera_ray(const RenderContext& ctx, const CameraSample& sample, Sampler& sampler,
                      TileCounters& counters, PixelResult* result);

}  // namespace kaustik::render
