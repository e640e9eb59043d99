#pragma once
// The shares of paths in light that they divide with photons (photon/sources/source_split.h).

#include "render/camera/shading_point.h"
#include "render/estimators/render_context.h"

namespace kaustik::render {

// Whether paths bring some of the light that they divide with photons.
inline bool paths_share(const RenderContext& ctx) {
  return ctx.maps.split && ctx.maps.split->sources.leaves_to_paths();
}

// Share of paths in what y scatters on of the light that comes straight from the lights.
inline float path_share_of_surface(const RenderContext& ctx, const ShadingPoint& y) {
  if (ctx.plan.indirect != IndirectEstimator::kSplit) return 1;
  if (!ctx.maps.split) return 0;
  const Normal3 n = glm::dot(y.wo, y.si.n) < 0 ? -y.si.n : y.si.n;
  return 1 - ctx.maps.split->sources.of_surface(y.si.p, n, transmits(*y.bsdf));
}

// Shares of the lights that count.
struct LightShares {
  float all = 1;                               // factor for all lights
  const photon::SourceSplit* split = nullptr;  // null: nothing depends on the light

  // to_light: a ray of unit direction that meets the light.
  float of(uint32_t light, const Ray& to_light) const {
    return split && all > 0 ? all * (1 - split->of_light(light, to_light)) : all;
  }
  // The same for a light that no ray can hit, of which a glossy lobe sends on the radiance L.
  float of_glossy(const Rgb& L) const {
    return split && all > 0 ? all * (1 - split->share_of(luminance(L))) : all;
  }
};

// Shares of paths in what lights send through specular surfaces, times `all`.
inline LightShares path_shares_of_lights(const RenderContext& ctx, float all) {
  if (!ctx.maps.split) return {0};
  return {all, &ctx.maps.split->sources};
}

}  // namespace kaustik::render
