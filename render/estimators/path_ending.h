#pragma once
// Where a path from the camera may end before its light does (render/maps/path_ends.h).

#include <optional>

#include "render/camera/shading_point.h"
#include "render/estimators/lighting.h"
#include "render/estimators/render_context.h"

namespace kaustik::render {

// How a path ends at y, if it does.
struct Ending {
  // What y scatters on of the light that does not come straight from lights, were it white; W/(m^2 sr).
  // Empty: the path goes on.
  std::optional<Rgb> radiance;
  LightWeight weight = LightWeight::kMis;  // of light samples at y
};

// area: of the surface at y for which the path stands, m^2. The path may end there if the discs from which
// the light was estimated are smaller, so that they blur no more than the path itself does. Light samples
// have no partner then, unless the lobe that was sampled next needs one.
inline Ending end_of_path(const RenderContext& ctx, const ShadingPoint& y, float area) {
  if (!ctx.maps.ends || !lobes(*y.bsdf).diffuse || transmits(*y.bsdf)) return {};
  const float r = ctx.maps.ends->radius();
  if (area < kPi * r * r) return {};
  const Normal3 n = glm::dot(y.wo, y.si.n) < 0 ? -y.si.n : y.si.n;
  const std::optional<Rgb> radiance = ctx.maps.ends->at(y.si.p, n, y.si.surface_group);
  const bool alone = radiance && !direct_needs_bsdf_sample(ctx.scene, y);
  return {radiance, alone ? LightWeight::kAlone : LightWeight::kMis};
}

}  // namespace kaustik::render
