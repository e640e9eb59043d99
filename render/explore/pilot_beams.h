#pragma once
// Camera rays through media that scatter light: where light is gathered along rays.

#include <vector>

#include "render/camera/beam.h"
#include "render/plan/render_input.h"

namespace kaustik::render {

// Traces `count` rays of the views, through mirrors and glass, and returns their parts in media that scatter.
// With settings.for_camera = kAll, the rays are those of the lamps. A function of scene and settings.
std::vector<Beam> pilot_beams(const RenderInput& input, uint32_t count);

}  // namespace kaustik::render
