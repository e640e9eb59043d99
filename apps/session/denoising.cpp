#include "apps/session/denoising.h"

#include "apps/session/stopping/stop_rules.h"
#include "core/stopwatch.h"
#include "render/denoise/denoise.h"

namespace kaustik::app {

void settle_denoising(bool writes_sums, Settings* settings) {
  render::RenderSettings& render = settings->render;
  if (render.denoise) return;
  const bool counts = writes_sums || settings->stop.target_error || render.passes > 0 ||
                      !render.crop.empty() || render.method == render::Method::kMc ||
                      names_error_layer(render.aov) || render.estimate_bias.value_or(false);
  if (counts || !settings->stop.seconds) render.denoise = !counts && render.spp <= kSamplesDenoised;
}

std::optional<render::Image> denoised(const render::RenderResult& result,
                                      const render::RenderSettings& settings, const Console& console,
                                      double* seconds) {
  if (!settings.denoise.value_or(false) || result.shown != render::Shown::kPasses) return {};
  if (!render::any_halves(result.halves)) {
    console.note(
        "the picture is not denoised: that takes two samples of each pixel, in two passes if there are "
        "passes");
    return {};
  }
  const Stopwatch watch;
  try {
    render::Image image = render::denoise(result.film, result.halves);
    *seconds = watch.seconds();
    return image;
  } catch (const std::bad_alloc&) {
    console.warning("the picture is not denoised: out of memory");
    return {};
  }
}

}  // namespace kaustik::app
