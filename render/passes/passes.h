#pragma once
// Chooses the number of passes of a render.

#include <cstdint>

#include "render/plan/render_input.h"

namespace kaustik::render {

// Returns settings.passes if set; otherwise as many passes as are needed for the photons of each to fit into
// settings.photon_memory less, for several, settings.sums_memory. If there are several, adds a note to the
// plan. The image then depends on that memory, though only in its noise; settings.passes makes it
// independent. Throws std::invalid_argument for more passes than photons, and std::runtime_error if the
// photons of one pass would not fit, or only with 2^31 passes or more.
uint64_t choose_passes(const Scene& scene, const accel::Bvh& bvh, const RenderSettings& settings,
                       EstimatorPlan* plan);

}  // namespace kaustik::render
