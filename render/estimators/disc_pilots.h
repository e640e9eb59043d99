#pragma once
// Measures by paths what the discs of the indirect map get wrong.

#include <memory>

#include "render/estimators/path_integrator.h"

namespace kaustik::render {

// Traces paths from visible points, about one for every eight samples of the pass, and compares them with
// the discs there. Null where the plan takes no discs that paths could replace. A function of scene, settings
// and pass. ctx.discs is not read.
std::unique_ptr<const DiscCorrection> measure_discs(const RenderContext& ctx);

// How far a final gather follows paths. With fewer than eight bounces it follows them to their end: the
// photons that are read at the far end of a diffuse segment may have one event too many, whose light fades
// with each bounce. So it does where there are caustics and no map of them, which would be missing at the
// end.
PathReach final_gather_reach(const RenderContext& ctx);

}  // namespace kaustik::render
