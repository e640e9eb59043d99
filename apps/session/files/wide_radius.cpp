#include "apps/session/files/wide_radius.h"

#include <fmt/format.h>

#include "render/plan/plan.h"

namespace kaustik::app {

namespace {

// Shares of the scene's diagonal. A disc that is wider than kWide reaches over most of a room's wall. The
// automatic radii of a million photons lie between the others in the scenes of the folder scenes/; those of
// 20 thousand are up to 0.13.
constexpr double kWide = 0.25, kUsualLeast = 0.01, kUsualMost = 0.03;

}  // namespace

std::string why_wide(const Scene& scene, const render::RenderSettings& settings) {
  const double diagonal = 2 * double(scene.bounds.radius());
  if (!settings.radius || !(double(*settings.radius) > kWide * diagonal) || diagonal == 0) return {};
  if (!render::kinds_needed(render::make_plan(settings, scene.needs)).any()) return {};
  return fmt::format(
      "the gather radius of {:.3g} m is {:.0f} % of the scene's diagonal, {:.3g} m: light is blurred over "
      "most of the scene, and gathers take long. Automatic radii of a million photons are mostly 1 % to 3 % "
      "of "
      "it, here {:.2g} m to {:.2g} m; leave --radius out, or scale the automatic radius, as by --radius 0.5x",
      *settings.radius, 100 * double(*settings.radius) / diagonal, diagonal, kUsualLeast * diagonal,
      kUsualMost * diagonal);
}

}  // namespace kaustik::app
