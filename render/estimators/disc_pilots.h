#pragma once
// Measures by paths what the discs of the indirect map get wrong.

#include <memory>

#include "render/estimators/path_integrator.h"

namespace kaustik::render {

// Visible points from which the discs are measured: 1,024 to 65,536, four paths from each and one path for
// every eight of `samples` a pixel. 0 where the plan takes no discs that paths could replace.
uint64_t disc_pilot_points(const RenderContext& ctx, uint64_t samples);

// Traces paths from so many visible points and compares their mean with the disc there. Null for no points. A
// function of scene, settings, pass and points. ctx.discs is not read.
std::unique_ptr<const DiscCorrection> measure_discs(const RenderContext& ctx, uint64_t points);

// How far a final gather follows paths. With fewer than eight bounces it follows them to their end: the
// photons that are gathered at the far end of a diffuse segment may have one event too many, whose light
// fades with each bounce. So it does where there are caustics and no map of them, which would be missing at
// the end.
PathReach final_gather_reach(const RenderContext& ctx);

}  // namespace kaustik::render
