#pragma once
// Traces paths from the camera side for the `paths` estimators: direct, caustic and indirect light.

#include "render/estimators/lighting.h"

namespace kaustik::render {

// Radiance leaving x towards x.wo, by class, W/(m^2 sr).
struct PathLight {
  Rgb direct{0}, caustic{0}, indirect{0};

  PathLight& operator+=(const PathLight& other) {
    direct += other.direct, caustic += other.caustic, indirect += other.indirect;
    return *this;
  }
};

// How far a path is followed. Each value includes what the ones before it find.
enum class PathReach {
  kNone,
  kLights,    // one ray: lights that are seen straight from x
  kSpecular,  // through specular surfaces to a light: caustics
  kRoulette   // until Russian roulette ends the path
};

// Whose light a path collects.
enum class PathSources {
  kLights,  // that of Scene::lights
  kMedia,   // what media emit
  kLightsAndMedia
};

// Traces one path that starts at x with a sample of its diffuse lobes. What it meets decides the class:
//
//   a light straight from x                direct, with the MIS weight of BSDF sampling (if samples_lights())
//   a light after specular surfaces only   caustic (--caustics paths, split)
//   light after a second diffuse event     indirect (reach kRoulette)
//
// At each further non-specular point y the path collects light samples (with MIS) and the light that arrives
// at y through specular surfaces. The latter comes from the caustic map if there is one, and lights met
// through specular surfaces are then not counted again; otherwise from lights met and, at glossy lobes,
// lights sampled. `--caustics off` therefore leaves out only the class L S+ D S* E; indirect light stays
// complete as far as paths can find it. Where photons carry a share of the light of its sources, the path
// counts the rest (photon/sources/source_split.h). Russian roulette starts at the third non-specular point.
// Unbiased except for the maps' kernels. At most max_bounces scattering events from x to the light, x
// included, apart from those of the map's photons. Requires reach > kNone.
//
// Light that dispersive glass refracts on the way has one wavelength. If x has one already, the path has
// that, and the result is what at_wavelength() is then to be applied to; otherwise the path samples one.
PathLight trace_path(const RenderContext& ctx, const ShadingPoint& x, PathReach reach, Sampler& sampler,
                     TileCounters& counters, PathSources sources = PathSources::kLights);

// The same from a point in a medium, by its phase function. What media scatter counts as diffuse: light that
// meets x through specular surfaces is a caustic. Points in media
// that the path meets later read no map: it finds the lights itself, through specular surfaces, too.
PathLight trace_path(const RenderContext& ctx, const MediumPoint& x, PathReach reach, Sampler& sampler,
                     TileCounters& counters, PathSources sources = PathSources::kLights);

// Traces a path of this reach from x, unless that is kNone, for the light of lights, and collects what media
// emit, all of which paths find (docs/decisions/063-media-emit.md): by the same path where it is followed to
// its end, otherwise by another one. of_media: how far, at most, a path is followed for that.
template <class Point>
PathLight trace_paths(const RenderContext& ctx, const Point& x, PathReach reach, PathReach of_media,
                      Sampler& sampler, TileCounters& counters);

}  // namespace kaustik::render
