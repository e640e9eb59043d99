#pragma once
// Light that arrives straight from the lights: next-event estimation, emission met by rays, and the MIS
// weights that combine the two.

#include "render/camera/medium_point.h"
#include "render/camera/shading_point.h"
#include "render/estimators/path_shares.h"
#include "render/estimators/render_context.h"

namespace kaustik::render {

// Share of the direct light that next-event estimation accounts for.
enum class LightWeight {
  kAlone,  // all of it
  kMis     // its MIS share against BSDF sampling (power heuristic, Veach 1997, section 9.2.4)
};

// Estimates  int f(wo, wi) Le V |cos| dwi  over all lights, in W/(m^2 sr). Few lights are all sampled, with a
// shadow ray each: one ray for all of them could not tell a light that is hidden from one that is not. Of
// many lights kLightChoices samples are drawn from the scene's LightSampler, and one of them is chosen for
// the only shadow ray by its contribution (resampled importance sampling, Talbot et al. 2005). Any surface in
// between blocks, including glass, since light through specular surfaces belongs to the caustic class. Delta
// lights always have weight one. With ctx.visibility most shadow rays are skipped, and V is an unbiased
// estimate that may be negative (photon/visibility/visibility_tree.h). The number of dimensions that are
// drawn depends on the number of lights only. part: the lobes of f that count; shares: of the lights.
Rgb sample_direct(const RenderContext& ctx, const ShadingPoint& x, LightWeight weight, Sampler& sampler,
                  TileCounters& counters, LobePart part = LobePart::kDiffuse, const LightShares& shares = {});

// The same with the phase function of a point in a medium in place of f and the cosine.
Rgb sample_direct(const RenderContext& ctx, const MediumPoint& x, LightWeight weight, Sampler& sampler,
                  TileCounters& counters);

// Number of samples that compete for the shadow ray where the scene has more lights than can all be sampled.
inline constexpr uint32_t kLightChoices = 4;

// Whether light samples alone are noisy at x, so that the direct light there should be shared with a BSDF
// sample: beside an extended light, where a few samples of its area carry nearly all of its light, and at
// rough microfacet lobes, which reflect little of most lights.
bool direct_needs_bsdf_sample(const Scene& scene, const ShadingPoint& x);

// Direct light as if nothing were in the way (V = 1). Sums all lights, so that noise comes only from their
// extent; of more than kMostLightsSummed lights one is chosen. Always draws three dimensions.
inline constexpr size_t kMostLightsSummed = 16;
Rgb unoccluded_direct(const RenderContext& ctx, const ShadingPoint& x, Sampler& sampler);

// Radiance that a surface point itself emits towards w (unit, world).
Rgb emitted(const Scene& scene, const SurfaceInteraction& si, const Vector3& w);

// Radiance of the infinite lights, for a ray of unit direction that escapes.
Rgb escaped(const Scene& scene, const Ray& ray, const LightShares& shares = {});

// MIS weight of BSDF sampling, bsdf_pdf^2 / (bsdf_pdf^2 + light_pdf^2), for a ray from x in direction wi that
// met the emitter `si`; bsdf_pdf is its density.
float emitter_hit_weight(const Scene& scene, const LightReceiver& x, const Vector3& wi, float bsdf_pdf,
                         const SurfaceInteraction& si);

// Radiance of the infinite lights for a ray from x that escapes, each light multiplied by the MIS weight of
// BSDF sampling.
Rgb escaped_weighted(const RenderContext& ctx, const LightReceiver& x, const Ray& ray, float bsdf_pdf,
                     const LightShares& shares = {});

}  // namespace kaustik::render
