#pragma once
// Light that arrives straight from the lights: next-event estimation, emission met by rays, and the weights
// that join the two.

#include "render/estimators/shading_point.h"
#include "render/render_context.h"

namespace kaustik::render {

// Which part of the direct light next-event estimation owns.
enum class LightWeight {
  kAlone,  // all of it
  kMis     // its share against BSDF sampling (power heuristic, Veach 1997, section 9.2.4)
};

// Estimate of  int f(wo, wi) Le V |cos| dwi  over all lights, W/(m^2 sr), by one shadow ray at most. Few
// lights are all sampled, and one of them looked for by what it brings (resampling, Talbot et al. 2005); of
// many, one is chosen by the scene's LightSampler. Anything between blocks, glass too: light through specular
// surfaces belongs to the caustic class. Delta lights always have weight one. With ctx.maps.visibility most
// shadow rays are not traced and V is an unbiased estimate, of either sign
// (photon/visibility/visibility_tree.h). Draws three dimensions, always. part: of f, the lobes that count.
Rgb sample_direct(const RenderContext& ctx, const ShadingPoint& x, LightWeight weight, Sampler& sampler,
                  TileCounters& counters, LobePart part = LobePart::kBroad);

// The same as if nothing were in the way, V = 1, and of every light, so that only the lights' extent makes
// noise; of one that is chosen where there are more than kMostLightsSummed. Draws three dimensions,
// always.
inline constexpr size_t kMostLightsSummed = 16;
Rgb unoccluded_direct(const RenderContext& ctx, const ShadingPoint& x, Sampler& sampler);

// Radiance that a surface point itself emits towards w (unit, world).
Rgb emitted(const Scene& scene, const SurfaceInteraction& si, const Vector3& w);

// Radiance of the infinite lights, for a ray of unit direction that escapes.
Rgb escaped(const Scene& scene, const Ray& ray);

// The share of BSDF sampling for a ray from x in direction wi, of density bsdf_pdf, that met emitter `si`:
// bsdf_pdf^2 / (bsdf_pdf^2 + light_pdf^2).
float emitter_hit_weight(const Scene& scene, const LightReceiver& x, const Vector3& wi, float bsdf_pdf,
                         const SurfaceInteraction& si);

// Radiance of the infinite lights for a ray from x that escapes, times the share of BSDF sampling, each light
// with its own.
Rgb escaped_weighted(const Scene& scene, const LightReceiver& x, const Ray& ray, float bsdf_pdf);

}  // namespace kaustik::render
