#pragma once
// Traces paths from the camera side for the `paths` estimators: direct, caustic and indirect light.

#include "render/estimators/lighting.h"

namespace kaustik::render {

// Radiance leaving x towards x.wo, by class, W/(m^2 sr).
struct PathLight {
  Rgb direct{0}, caustic{0}, indirect{0};
};

// Traces one path that starts at x with a sample of its diffuse lobes. What it meets decides the class:
//
//   a light straight from x                direct, with the MIS weight of BSDF sampling (if samples_lights())
//   a light after specular surfaces only   caustic (--caustics paths)
//   light after a second diffuse event     indirect (--indirect paths)
//
// At each further non-specular point y the path collects light samples (with MIS) and the light that arrives
// at y through specular surfaces. The latter comes from the caustic map if there is one, and lights met
// through specular surfaces are then not counted again; otherwise from lights met and, at glossy lobes,
// lights sampled. `--caustics off` therefore leaves out only the class L S+ D S* E; indirect light stays
// complete as far as paths can find it. Russian roulette starts at the third non-specular point. Unbiased
// except for the caustic map's kernel. At most max_bounces scattering events from x to the light, x included.
// Requires traces_paths(ctx.plan).
PathLight trace_path(const RenderContext& ctx, const ShadingPoint& x, Sampler& sampler,
                     TileCounters& counters);

}  // namespace kaustik::render
