#pragma once
// Builds the BVH, then renders: `render` does this once, `bench` many times.

#include "render/renderer.h"
#include "render/statistics_json.h"

namespace kaustik::app {

struct RenderOutcome {
  render::RenderResult result;
  render::OuterTimes times;  // only `bvh` is set
};

// Runs on the threads of the calling task arena; settings.threads limits the build of the BVH.
RenderOutcome render_job(const Scene& scene, const render::RenderSettings& settings,
                         const render::ProgressCallback& progress, render::RenderTask task = {});

}  // namespace kaustik::app
