#pragma once
// Light that a medium scatters towards the camera along one of its rays.

#include "render/camera/beam.h"
#include "render/estimators/path_integrator.h"
#include "render/film/film.h"

namespace kaustik::render {

// Estimates  int_0^distance T(t) sigma_s(t) int p(wo, wi) L(t, wi) dwi dt  by class, W/(m^2 sr). Direct light
// comes from a light sample at one point of the ray. Caustics and indirect light come from the photons near
// the ray or, if the plan has no photons in media, from a path that starts at that point. beta: the ray's
// throughput, which decides how likely a sample is, but is not a factor of the result. Returns zero for media
// that do not scatter. light: kTraced leaves out the photons. of_media: how far, at most, a path is followed
// for the light that media emit. Draws as many dimensions as it needs.
PathLight scattered_light(const RenderContext& ctx, const Beam& beam, const Rgb& beta, SampleLight light,
                          PathReach of_media, Sampler& sampler, TileCounters& counters);

}  // namespace kaustik::render
