#pragma once
// Light that media emit and that arrives straight at a point, through no surface: samples of it, and the MIS
// weights that combine them with rays that happen to meet the media (as render/estimators/lighting.h does for
// lights).

#include "render/camera/medium_point.h"
#include "render/camera/shading_point.h"
#include "render/estimators/render_context.h"

namespace kaustik::render {

// Estimates  int f(wo, wi) Le |cos| dwi, W/(m^2 sr), over the directions towards Scene::emissive_bodies,
// where Le is what media emit along a ray up to the first surface: the MIS share against BSDF sampling. f: of
// the diffuse lobes. Draws three dimensions and traces one ray, if there are such bodies.
Rgb sample_emission_of_media(const RenderContext& ctx, const ShadingPoint& x, Sampler& sampler,
                             TileCounters& counters);
// The same with the phase function of a point in a medium in place of f and the cosine.
Rgb sample_emission_of_media(const RenderContext& ctx, const MediumPoint& x, Sampler& sampler,
                             TileCounters& counters);

// MIS weight of BSDF sampling for what media emit along a ray from x in direction wi; bsdf_pdf is the ray's
// density.
float emission_of_media_weight(const Scene& scene, const Point3& x, const Vector3& wi, float bsdf_pdf);

}  // namespace kaustik::render
