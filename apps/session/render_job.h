#pragma once
// The rays' tree, then the picture: what `render` does once and `bench` many times.

#include "render/renderer.h"
#include "render/statistics_json.h"

namespace kaustik::app {

struct RenderOutcome {
  render::RenderResult result;
  render::OuterTimes times;  // bvh alone
};

// On the calling arena's threads; settings.threads bounds the build of the tree.
RenderOutcome render_job(const Scene& scene, const render::RenderSettings& settings,
                         const render::ProgressCallback& progress, render::RenderTask task = {});

}  // namespace kaustik::app
