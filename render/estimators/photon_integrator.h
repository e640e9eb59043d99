#pragma once
// Radiance along one camera ray: the rendering equation, split by classes of paths.

#include "core/sampling/sampler.h"
#include "photon/estimate/estimate_batch.h"
#include "render/estimators/render_context.h"
#include "render/film/film.h"

namespace kaustik::render {

// What a sample finds by way of dispersive glass: light of which only that of one wavelength counts.
struct DispersedLight {
  PixelResult light;
  float wavelength = kNoWavelength;

  // Adds it to the sample's other light.
  void add_to(PixelResult* sample) const;
};

// One sample of a pixel: its camera ray and the hit of that ray.
struct CameraSample {
  Ray ray;
  Hit hit;
  bool with_bias = false;                  // also estimate the kernels' bias, by a second, smaller gather
  photon::EstimateBatch* batch = nullptr;  // estimates that can be deferred are added to it
  SampleLight light = SampleLight::kAll;   // kTraced requires a plan without camera paths
  DispersedLight* dispersed = nullptr;     // must not be null if the scene needs dispersion
};

// Traces the sample and adds it to *result, which must be empty; deferred estimates are added when the batch
// is flushed. Sets radiance by class in W/(m^2 sr); albedo, normal and depth of the first hit; and the number
// of photons within reach of the queries. Light that dispersive glass refracts goes to *sample.dispersed.
// Draws as many dimensions of `sampler` as it needs.
void trace_camera_ray(const RenderContext& ctx, const CameraSample& sample, Sampler& sampler,
                      TileCounters& counters, PixelResult* result);

}  // namespace kaustik::render
