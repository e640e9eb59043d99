#pragma once
// Measures by paths what the discs of the indirect map get wrong.

#include <memory>

#include "render/estimators/path_integrator.h"

namespace kaustik::render {

// Traces paths from 64 to 65,536 visible points, four from each and one for every four samples of the pass,
// and compares their mean with the disc there. Null where the plan takes no discs that paths could replace. A
// function of scene, settings and pass. ctx.discs is not read.
std::unique_ptr<const DiscCorrection> measure_discs(const RenderContext& ctx);

// How far a final gather follows paths. With fewer than eight bounces it follows them to their end: the
// photons that are gathered at the far end of a diffuse segment may have one event too many, whose light
// fades with each bounce. So it does where there are caustics and no map of them, which would be missing at
// the end.
PathReach final_gather_reach(const RenderContext& ctx);

}  // namespace kaustik::render
