#pragma once
// How much memory the parts of a render will take, before they are made. The numbers are upper bounds for
// usual scenes.

#include <cstdint>

#include "core/geometry/side_estimate.h"
#include "render/plan/render_input.h"

namespace kaustik::render {

// Bytes for each pixel of the film of a render in one pass whose sums are not kept: what its samples add up
// to, and the picture with its halves. denoise() takes less, and comes when the sums are gone.
uint64_t film_bytes_per_pixel(const RenderSettings& settings, const SceneNeeds& needs);

// Bytes for each pixel of the exact sums over passes, which renders of several passes, and those that are
// resumed or merged, keep besides.
uint64_t sums_bytes_per_pixel(const RenderSettings& settings, const SceneNeeds& needs);

// Bytes of what estimates from photons know about surfaces: their edges, the walls that stand on them, and
// the areas of curved ones (PassPhotons); and of what tells paths where to end (PathEnds). 0 if the settings
// need neither.
uint64_t surfaces_bytes(const Scene& scene, const SideEstimate& sides, const RenderSettings& settings);

// Bytes that the photons of one of `passes` passes will take at their peak, from a small shoot.
uint64_t photons_bytes(const RenderInput& input, uint64_t passes);

}  // namespace kaustik::render
