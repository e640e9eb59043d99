#include "apps/session/render_job.h"

#include "core/parallel/work_span.h"

namespace kaustik::app {

RenderOutcome render_job(const Scene& scene, const render::RenderSettings& settings,
                         const render::ProgressCallback& progress, render::RenderTask task) {
  RenderOutcome outcome;
  const PhaseWatch watch;
  const accel::Bvh bvh(scene, settings.threads);
  outcome.times.bvh = watch.end("bvh");
  outcome.result = render::render(scene, bvh, settings, progress, std::move(task));
  return outcome;
}

}  // namespace kaustik::app
