// The path loop: emission, light samples, scattering by surfaces and media, Russian roulette.

#include "render/estimators/path_integrator.h"

#include "accel/media_walk.h"
#include "core/medium/free_path.h"
#include "render/estimators/emission_of_media.h"
#include "render/estimators/path_ending.h"
#include "render/estimators/scattered_light.h"

namespace kaustik::render {

namespace {

// State of a path while it is traced.
struct PathState {
  PathSources sources = PathSources::kLights;
  Rgb beta{1};                       // throughput since x
  float roulette = 1;                // largest component of the throughput without the eta^2 of refractions
  int events = 1;                    // scattering events since x, x included
  int diffuse = 0;                   // scattering events by diffuse lobes or media, x included
  bool from_medium = false;          // the last of these was in a medium
  bool specular = false;             // the last event was specular
  float share = 1;                   // of paths in the light of the last diffuse event
  bool has_pdf = false;              // that event was by no delta lobe, so lights were sampled there too
  LightReceiver ref;                 // where that event was
  float pdf = 0;                     // density of the ray that left it
  Point3 from{0};                    // the point that the ray left
  float spread = 0;                  // inverse of the density of the last diffuse event
  float way = 0;                     // metres since then
  MediumIndex medium = kVacuum;      // of the ray
  float wavelength = kNoWavelength;  // for which dispersive glass refracts
  bool dispersed = false;            // the path has only this wavelength
  Rgb before{1};                     // throughput up to where it was dispersed, of which beta is free then
};

// The wavelength of points that the path meets.
float wavelength_of(const PathState& path) {
  return path.dispersed ? path.wavelength : kNoWavelength;
}

// Gives the path one wavelength from here on. As for photons, colours on either side of the glass are RGB:
// those between x and the glass apply to the RGB colour of the light that has the wavelength.
void disperse(PathState* path) {
  if (path->dispersed) return;
  path->dispersed = true;
  path->before = path->beta;
  path->beta = Rgb(1);
}

// Whether the caustic map tells what light comes to the points of a path through specular surfaces. Where
// sources are split, photons carry their share of it on into the indirect map.
bool caustics_by_map(const RenderContext& ctx) {
  return reads_caustic_photons(ctx.plan) && ctx.plan.indirect != IndirectEstimator::kSplit;
}

bool follows_indirect(PathReach reach) {
  return reach == PathReach::kRoulette;
}

bool collects_lights(const PathState& path) {
  return path.sources != PathSources::kMedia;
}
bool collects_media(const PathState& path) {
  return path.sources != PathSources::kLights;
}

// Where light that the path meets is added; null when another estimator accounts for it. specular: whether
// the event that leads to the light is specular. Points in media that paths meet read no map.
Rgb* owner_of_light(const RenderContext& ctx, const PathState& path, bool specular, PathLight* light) {
  if (path.diffuse > 1) {
    const bool all_by_map = caustics_by_map(ctx) && ctx.plan.caustics == CausticEstimator::kPhotons;
    return specular && all_by_map && !path.from_medium ? nullptr : &light->indirect;
  }
  const bool finds_caustics =
      ctx.plan.caustics == CausticEstimator::kPaths || ctx.plan.caustics == CausticEstimator::kSplit;
  if (specular) return finds_caustics ? &light->caustic : nullptr;
  return path.from_medium || samples_lights(ctx.plan.direct) ? &light->direct : nullptr;
}

// The same for what media emit.
Rgb* owner_of_emission(const RenderContext& ctx, const PathState& path, PathLight* light) {
  if (path.diffuse > 1) return &light->indirect;
  if (!path.specular) return &light->direct;
  return ctx.plan.caustics != CausticEstimator::kOff ? &light->caustic : nullptr;
}

// Shares of paths in the lights that the path meets. specular: whether the event that leads to them is
// specular.
LightShares shares_of_met(const RenderContext& ctx, const PathState& path, bool specular) {
  const bool split_indirect = path.diffuse > 1 && ctx.plan.indirect == IndirectEstimator::kSplit;
  const float of_surface = split_indirect ? path.share : 1;
  // Other indirect light that comes through specular surfaces has the caustic map's share at its last point.
  const bool split_lights =
      specular && !path.from_medium && (split_indirect || ctx.plan.caustics == CausticEstimator::kSplit);
  return split_lights ? path_shares_of_lights(ctx, of_surface) : LightShares{of_surface};
}

// Adds what the media emit between the ray's start and `distance`, wherever the path itself is scattered.
void add_emission_of_media(const RenderContext& ctx, const PathState& path, const Ray& ray, float distance,
                           PathLight* light) {
  Rgb* const owner = owner_of_emission(ctx, path, light);
  if (!owner) return;
  const Rgb Le = accel::emitted_radiance(ctx.scene, ctx.bvh.interfaces(), ray, distance, path.medium);
  if (is_black(Le)) return;
  const float w = path.specular ? 1 : emission_of_media_weight(ctx.scene, path.ref.p, ray.d, path.pdf);
  *owner += path.beta * Le * w;
}

void add_light(const RenderContext& ctx, const PathState& path, const SurfaceInteraction& si, const Ray& ray,
               PathLight* light) {
  const Rgb Le = emitted(ctx.scene, si, -ray.d);
  if (is_black(Le)) return;
  Rgb* owner = owner_of_light(ctx, path, path.specular, light);
  if (!owner) return;
  const float w = path.has_pdf ? emitter_hit_weight(ctx.scene, path.ref, ray.d, path.pdf, si) : 1;
  *owner += path.beta * Le * (w * shares_of_met(ctx, path, path.specular).of(si.light, ray));
}

void add_escape(const RenderContext& ctx, const PathState& path, const Ray& ray, PathLight* light) {
  if (ctx.scene.infinite_lights.empty()) return;
  Rgb* const owner = owner_of_light(ctx, path, path.specular, light);
  if (!owner) return;
  const LightShares shares = shares_of_met(ctx, path, path.specular);
  *owner += path.beta * (path.has_pdf ? escaped_weighted(ctx, path.ref, ray, path.pdf, shares)
                                      : escaped(ctx.scene, ray, shares));
}

// Light that arrives at y, the end of a diffuse segment, from the lights and through specular surfaces, and
// is scattered along the path by y's diffuse lobes. Where paths end, the latter is part of what they end in.
Rgb arriving(const RenderContext& ctx, const ShadingPoint& y, const Ending& ending, Sampler& sampler,
             TileCounters& counters) {
  Rgb sum = sample_direct(ctx, y, ending.weight, sampler, counters);
  if (caustics_by_map(ctx) && !ending.radiance)
    sum += photon::estimate_radiance(ctx.maps.caustic.map, y.si, y.wo, *y.bsdf, ctx.maps.caustic.estimate,
                                     counters.gather);
  return sum;
}

// Takes the path through the media between the ray's start and `distance` as far as one of them scatters it;
// then returns the point. Either way the throughput takes its weight. Draws two dimensions.
std::optional<MediumPoint> scatter_in_media(const RenderContext& ctx, const Ray& ray, float distance,
                                            PathState* path, Sampler& sampler) {
  FreePath way(path->beta, sampler.next_2d());
  std::optional<MediumPoint> met;
  Rgb weight;
  path->medium = accel::walk_media(ctx.bvh.interfaces(), ray, distance, path->medium,
                                   [&](MediumIndex m, float begin, float end) {
                                     const Medium& medium = ctx.scene.media[m];
                                     const auto passed = way.pass(medium, column_of(medium, ray, begin, end));
                                     if (!passed) return true;
                                     const Point3 p = ray.at(place_of(*passed, medium, ray, begin, end));
                                     met = MediumPoint{p, -ray.d, medium.g, m, wavelength_of(*path)};
                                     weight = way.scattered(medium);
                                     return false;
                                   });
  if (!met) weight = way.passed();
  const float before = max_component(path->beta);
  path->beta *= weight;
  path->roulette *= before > 0 ? max_component(path->beta) / before : 0;
  return met;
}

// Adds what the media along the ray scatter towards its start, and leaves of the throughput what they let
// pass.
void gather_in_media(const RenderContext& ctx, const Ray& ray, float distance, bool scattered,
                     PathState* path, PathLight* light, Sampler& sampler, TileCounters& counters) {
  path->medium = accel::walk_media(
      ctx.bvh.interfaces(), ray, distance, path->medium, [&](MediumIndex m, float begin, float end) {
        if (scattered) {
          const Beam beam{{ray.at(begin), ray.d}, end - begin, m, wavelength_of(*path)};
          const PathLight of =
              scattered_light(ctx, beam, path->beta, SampleLight::kAll, PathReach::kNone, sampler, counters);
          light->indirect += path->beta * (of.direct + of.caustic + of.indirect);
        }
        const Rgb left = transmittance(ctx.scene.media[m], ray, begin, end);
        path->beta *= left;
        path->roulette *= max_component(left);
        return true;
      });
}

// Continues the path from a point in a medium. Draws a pair of dimensions.
void continue_path(const MediumPoint& m, PathState* path, Ray* ray, Sampler& sampler) {
  const Vector3 wi = sample_phase(-m.wo, m.g, sampler.next_2d());
  path->specular = false;
  path->from_medium = true;
  ++path->diffuse;
  path->has_pdf = true;
  path->ref = m.receiver();
  path->pdf = scatter_pdf(m, wi);
  path->medium = m.medium;
  path->from = m.p;
  *ray = spawn(m, wi);
}

// Samples a scattering event and continues the path; false where it ends. share: of paths in the light that
// diffuse lobes scatter here.
bool continue_path(const Scene& scene, const ShadingPoint& v, Scatter part, float share, PathState* path,
                   Ray* ray, Sampler& sampler) {
  const auto s = scatter(v, sampler, part);
  if (!s || is_black(s->weight)) return false;
  if (selects_wavelength(*v.bsdf, v.wo_local, *s)) disperse(path);
  path->beta *= s->weight;
  if (!s->transmission) path->roulette *= max_component(s->weight);
  path->specular = s->specular;
  path->diffuse += !s->specular;
  if (!s->specular) {
    path->from_medium = false, path->share = share;
    path->spread = 1 / s->pdf, path->way = 0;
  }
  path->has_pdf = !s->specular || s->glossy;
  path->ref = v.receiver();
  path->pdf = s->pdf;
  path->medium = medium_towards(scene, v, s->wi);
  *ray = v.si.spawn(s->wi);
  return true;
}

// Russian roulette from the third diffuse event on (Pharr et al. 2023, section 13.2.2). The survival
// probability leaves out the eta^2 of refractions: radiance is larger in water, but not more important. False
// where the path ends. Draws one dimension.
bool survives(PathState* path, Sampler& sampler) {
  const float u = sampler.next_1d();
  if (path->diffuse < 2 || path->roulette >= 1) return true;
  const float q = std::max(path->roulette, 0.05f);
  if (u >= q) return false;
  path->beta /= q;
  path->roulette /= q;
  return true;
}

// Whether the path may end in light that photons brought.
bool may_end(const PathState& path, PathReach reach) {
  return follows_indirect(reach) && collects_lights(path) && !path.dispersed && !path.from_medium;
}

// The part of the surfaces at y for which the path stands, m^2.
float area_at(const ShadingPoint& y, const PathState& path) {
  return path.way * path.way * path.spread / abs_dot(y.wo, y.si.n);
}

// Adds the light that the path collects at y and chooses the lobes by which it goes on; nothing where it
// ends.
std::optional<Scatter> visit(const RenderContext& ctx, const ShadingPoint& y, PathReach reach, float share,
                             const Ending& ending, PathState* path, PathLight* light, Sampler& sampler,
                             TileCounters& counters) {
  const Lobes parts = lobes(*y.bsdf);
  if (parts.diffuse && follows_indirect(reach)) {
    if (collects_lights(*path))
      light->indirect += share * path->beta * arriving(ctx, y, ending, sampler, counters);
    if (collects_media(*path))
      light->indirect += path->beta * sample_emission_of_media(ctx, y, sampler, counters);
  }
  if (parts.glossy && collects_lights(*path)) {
    if (Rgb* owner = owner_of_light(ctx, *path, true, light))
      *owner += path->beta * sample_direct(ctx, y, LightWeight::kMis, sampler, counters, LobePart::kGlossy,
                                           shares_of_met(ctx, *path, true));
  }
  const bool specular_only = !follows_indirect(reach);
  if (specular_only && !parts.specular) return {};
  // Paths that end have no more to do.
  if (parts.diffuse && ending.radiance)
    sampler.next_1d();
  else if (parts.diffuse && !survives(path, sampler))
    return {};
  return specular_only ? Scatter::kSpecular : Scatter::kEither;
}

// Adds the light that arrives at m, and goes on from there; false where the path ends.
bool visit(const RenderContext& ctx, const MediumPoint& m, PathState* path, Ray* ray, PathLight* light,
           Sampler& sampler, TileCounters& counters) {
  if (++path->events > ctx.settings.max_bounces || is_black(path->beta)) return false;
  if (collects_lights(*path))
    light->indirect += path->beta * sample_direct(ctx, m, LightWeight::kMis, sampler, counters);
  if (collects_media(*path))
    light->indirect += path->beta * sample_emission_of_media(ctx, m, sampler, counters);
  if (!survives(path, sampler)) return false;
  continue_path(m, path, ray, sampler);
  return true;
}

// Whether photons in media stand for light that paths cannot find there: what mirrors and glass make of point
// lights. Paths that are scattered have the exact number of events instead.
bool needs_photons_in_media(const RenderContext& ctx, const PathState& path) {
  const SceneNeeds& needs = ctx.scene.needs;
  return collects_lights(path) && ctx.plan.medium_indirect && needs.specular && needs.only_delta_lights;
}

// Passes the media between the ray's start and what lies behind them. Paths that are followed to the maps
// take what media scatter towards them with them. Those that are followed to their end may be scattered; then
// the point is returned.
std::optional<MediumPoint> pass_media(const RenderContext& ctx, const Ray& ray, float distance,
                                      PathReach reach, PathState* path, PathLight* light, Sampler& sampler,
                                      TileCounters& counters) {
  if (!ctx.scene.needs.media || (path->medium == kVacuum && !ctx.scene.interfaces)) return {};
  if (collects_media(*path)) add_emission_of_media(ctx, *path, ray, distance, light);
  if (reach == PathReach::kRoulette && ctx.scene.needs.scattering && !needs_photons_in_media(ctx, *path))
    return scatter_in_media(ctx, ray, distance, path, sampler);
  gather_in_media(ctx, ray, distance, follows_indirect(reach), path, light, sampler, counters);
  return {};
}

// What a path collects before and after dispersive glass has refracted it.
struct LightByDispersion {
  PathLight before, after;

  PathLight* of(const PathState& path) { return path.dispersed ? &after : &before; }
  // The sum, where the path did not begin with one wavelength.
  PathLight sum(const PathState& path) const {
    const auto join = [&](const Rgb& a, const Rgb& b) {
      return is_black(b) ? a : a + path.before * at_wavelength(b, path.wavelength);
    };
    return {join(before.direct, after.direct), join(before.caustic, after.caustic),
            join(before.indirect, after.indirect)};
  }
};

// Follows a path from its first ray to its end.
void follow(const RenderContext& ctx, PathState& path, Ray ray, PathReach reach, LightByDispersion& light,
            Sampler& sampler, TileCounters& counters) {
  while (true) {
    // A ray that looks for lights alone counts as the shadow ray whose work it shares.
    ++(reach == PathReach::kLights ? counters.rays.shadow : counters.rays.bounce);
    SurfaceInteraction si;
    const bool met = ctx.bvh.intersect(ray, &si);
    const float distance = met ? glm::distance(si.p, path.from) : kInfinity;
    if (const auto m = pass_media(ctx, ray, distance, reach, &path, light.of(path), sampler, counters)) {
      if (!visit(ctx, *m, &path, &ray, light.of(path), sampler, counters)) return;
      continue;
    }
    if (collects_lights(path))
      met ? add_light(ctx, path, si, ray, light.of(path)) : add_escape(ctx, path, ray, light.of(path));
    if (!met) return;
    if (reach == PathReach::kLights || ++path.events > ctx.settings.max_bounces) return;
    path.from = si.p;
    ShadingPoint y(ctx.scene, si, -ray.d, {}, path.wavelength);
    if (scatters_one_wavelength(*y.bsdf)) disperse(&path);
    y.medium = path.medium, y.wavelength = wavelength_of(path);
    path.way += distance;
    const float share = lobes(*y.bsdf).diffuse ? path_share_of_surface(ctx, y) : 1;
    const Ending ending = may_end(path, reach) ? end_of_path(ctx, y, area_at(y, path)) : Ending{};
    const auto part = visit(ctx, y, reach, share, ending, &path, light.of(path), sampler, counters);
    if (!part || !continue_path(ctx.scene, y, *part, share, &path, &ray, sampler)) return;
    if (!ending.radiance || path.specular) continue;
    light.of(path)->indirect += path.beta * *ending.radiance;
    if (ending.weight == LightWeight::kAlone) return;
    reach = PathReach::kLights;
  }
}

// Follows the path from x, a point on a surface or in a medium. start: begins it.
template <class Point, class Start>
PathLight trace_from(const RenderContext& ctx, const Point& x, PathReach reach, Sampler& sampler,
                     TileCounters& counters, PathSources sources, const Start& start) {
  PathState path;
  path.sources = sources;
  path.from = position(x);
  path.wavelength = x.wavelength;
  path.dispersed = x.wavelength != kNoWavelength;
  if (ctx.scene.needs.dispersion && !path.dispersed) path.wavelength = sample_wavelength(sampler.next_1d());
  Ray ray;
  LightByDispersion light;
  if (collects_media(path)) light.of(path)->direct = sample_emission_of_media(ctx, x, sampler, counters);
  if (start(&path, &ray)) follow(ctx, path, ray, reach, light, sampler, counters);
  if (x.wavelength != kNoWavelength) return light.after;
  return path.dispersed ? light.sum(path) : light.before;
}

}  // namespace

PathLight trace_path(const RenderContext& ctx, const ShadingPoint& x, PathReach reach, Sampler& sampler,
                     TileCounters& counters, PathSources sources) {
  return trace_from(ctx, x, reach, sampler, counters, sources, [&](PathState* path, Ray* ray) {
    return continue_path(ctx.scene, x, Scatter::kDiffuse, 1, path, ray, sampler);
  });
}

PathLight trace_path(const RenderContext& ctx, const MediumPoint& x, PathReach reach, Sampler& sampler,
                     TileCounters& counters, PathSources sources) {
  return trace_from(ctx, x, reach, sampler, counters, sources, [&](PathState* path, Ray* ray) {
    continue_path(x, path, ray, sampler);
    return true;
  });
}

namespace {

// How far paths are followed for what media emit: as far as the plan has light of other sources.
PathReach reach_for_emission(const RenderContext& ctx) {
  if (!ctx.scene.needs.emissive_media) return PathReach::kNone;
  if (ctx.plan.indirect != IndirectEstimator::kOff) return PathReach::kRoulette;
  return ctx.plan.caustics != CausticEstimator::kOff ? PathReach::kSpecular : PathReach::kLights;
}

}  // namespace

template <class Point>
PathLight trace_paths(const RenderContext& ctx, const Point& x, PathReach reach, PathReach of_media,
                      Sampler& sampler, TileCounters& counters) {
  of_media = std::min(of_media, reach_for_emission(ctx));
  const bool same = ctx.plan.indirect == IndirectEstimator::kPaths && reach == of_media;
  const PathSources sources = same ? PathSources::kLightsAndMedia : PathSources::kLights;
  PathLight light;
  if (reach != PathReach::kNone) light = trace_path(ctx, x, reach, sampler, counters, sources);
  if (of_media != PathReach::kNone && !same)
    light += trace_path(ctx, x, of_media, sampler, counters, PathSources::kMedia);
  return light;
}
template PathLight trace_paths(const RenderContext&, const ShadingPoint&, PathReach, PathReach, Sampler&,
                               TileCounters&);
template PathLight trace_paths(const RenderContext&, const MediumPoint&, PathReach, PathReach, Sampler&,
                               TileCounters&);

}  // namespace kaustik::render
