#pragma once
// The radiance of one camera ray: the rendering equation, split by classes of paths.

#include "render/render_context.h"

namespace kaustik::render {

// One sample of a pixel, whose camera ray meets `first`. Radiance by class in W/(m^2 sr); albedo, normal and
// depth of the first hit; photons in reach of the queries at the first non-specular point. Draws from
// `sampler` what it needs. with_bias: the kernels' bias too, which takes a second, smaller
// gather.
PixelResult trace_camera_ray(const RenderContext& ctx, const Ray& ray, const Hit& first, Sampler& sampler,
                             TileCounters& counters, bool with_bias = false);

}  // namespace kaustik::render
