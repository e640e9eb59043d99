#pragma once
// Light found by following paths from the camera side: the direct, caustic and indirect classes of the
// `paths` estimators.

#include "render/estimators/lighting.h"

namespace kaustik::render {

// Radiance leaving x towards x.wo, by class, W/(m^2 sr).
struct PathLight {
  Rgb direct{0}, caustic{0}, indirect{0};
};

// Whether trace_path has anything to find under this plan.
bool traces_paths(const EstimatorPlan& plan);

// One path that starts at x with a sample of its broad lobes. What it meets decides the class:
//
//   a light straight from x                direct, by the weight of BSDF sampling (if samples_lights())
//   a light after specular surfaces only   caustic (--caustics paths)
//   what follows a second non-specular    indirect (--indirect paths)
//
// At each further non-specular point y: next-event estimation with MIS, and what arrives at y through
// specular surfaces: from the caustic map if there is one (then lights met through specular surfaces are not
// counted again), else from lights met, and at glossy lobes from lights sampled. `--caustics off` therefore
// leaves out the class L S+ D S* E alone, and the indirect light stays complete as far as paths can find it.
// Russian roulette from the third non-specular point on. Unbiased, but for the caustic map's kernel; at most
// max_bounces scattering events from x to the light, x included. Requires traces_paths(ctx.plan).
PathLight trace_path(const RenderContext& ctx, const ShadingPoint& x, Sampler& sampler,
                     TileCounters& counters);

}  // namespace kaustik::render
