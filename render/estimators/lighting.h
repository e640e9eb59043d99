#pragma once
// Light that arrives straight from the lights: next-event estimation, emission met by rays, and the MIS
// weights that combine the two.

#include "render/camera/shading_point.h"
#include "render/estimators/render_context.h"

namespace kaustik::render {

// Share of the direct light that next-event estimation accounts for.
enum class LightWeight {
  kAlone,  // all of it
  kMis     // its MIS share against BSDF sampling (power heuristic, Veach 1997, section 9.2.4)
};

// Estimates  int f(wo, wi) Le V |cos| dwi  over all lights, in W/(m^2 sr), with at most one shadow ray. Few
// lights are all sampled, and one of them is chosen for the shadow ray by its contribution (resampling,
// Talbot et al. 2005); of many lights one is chosen by the scene's LightSampler. Any surface in between
// blocks, including glass, since light through specular surfaces belongs to the caustic class. Delta lights
// always have weight one. With ctx.visibility most shadow rays are skipped, and V is an unbiased
// estimate that may be negative (photon/visibility/visibility_tree.h). Always draws three dimensions. part:
// the lobes of f that count.
Rgb sample_direct(const RenderContext& ctx, const ShadingPoint& x, LightWeight weight, Sampler& sampler,
                  TileCounters& counters, LobePart part = LobePart::kDiffuse);

// Direct light as if nothing were in the way (V = 1). Sums all lights, so that noise comes only from their
// extent; of more than kMostLightsSummed lights one is chosen. Always draws three dimensions.
inline constexpr size_t kMostLightsSummed = 16;
Rgb unoccluded_direct(const RenderContext& ctx, const ShadingPoint& x, Sampler& sampler);

// Radiance that a surface point itself emits towards w (unit, world).
Rgb emitted(const Scene& scene, const SurfaceInteraction& si, const Vector3& w);

// Radiance of the infinite lights, for a ray of unit direction that escapes.
Rgb escaped(const Scene& scene, const Ray& ray);

// MIS weight of BSDF sampling, bsdf_pdf^2 / (bsdf_pdf^2 + light_pdf^2), for a ray from x in direction wi that
// met the emitter `si`; bsdf_pdf is its density.
float emitter_hit_weight(const Scene& scene, const LightReceiver& x, const Vector3& wi, float bsdf_pdf,
                         const SurfaceInteraction& si);

// Radiance of the infinite lights for a ray from x that escapes, each light multiplied by the MIS weight of
// BSDF sampling.
Rgb escaped_weighted(const Scene& scene, const LightReceiver& x, const Ray& ray, float bsdf_pdf);

}  // namespace kaustik::render
