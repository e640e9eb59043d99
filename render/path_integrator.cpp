#include "render/path_integrator.h"

namespace kaustik::render {

namespace {

// One path while it is followed.
struct PathState {
  Rgb beta{1};            // throughput since x
  float roulette = 1;     // largest component of the throughput without the eta^2 of refractions
  int events = 1;         // scattering events since x, x included
  int diffuse = 1;        // non-specular points since x, x included
  bool specular = false;  // the last event was specular
  LightReceiver ref;      // last non-specular point: where densities are measured from
  float pdf = 0;          // density of the ray that left it
};

bool caustics_by_map(const RenderContext& ctx) {
  return ctx.plan.caustics == CausticEstimator::kPhotons;
}

bool follows_indirect(const RenderContext& ctx) {
  return ctx.plan.indirect == IndirectEstimator::kPaths;
}

// Where a lamp met by the path is counted, or nothing when another estimator owns it.
Rgb* owner_of_lamp(const RenderContext& ctx, const PathState& path, PathLight* light) {
  if (path.diffuse == 1) {
    if (path.specular) return ctx.plan.caustics == CausticEstimator::kPaths ? &light->caustic : nullptr;
    return samples_lamps(ctx.plan.direct) ? &light->direct : nullptr;
  }
  return path.specular && caustics_by_map(ctx) ? nullptr : &light->indirect;
}

void add_lamp(const RenderContext& ctx, const PathState& path, const SurfaceInteraction& si, const Ray& ray,
              PathLight* light) {
  const Rgb Le = emitted(ctx.scene, si, -ray.d);
  if (is_black(Le)) return;
  Rgb* owner = owner_of_lamp(ctx, path, light);
  if (!owner) return;
  const float w = path.specular ? 1 : emitter_hit_weight(ctx.scene, path.ref, ray.d, path.pdf, si);
  *owner += path.beta * Le * w;
}

void add_escape(const RenderContext& ctx, const PathState& path, const Ray& ray, PathLight* light) {
  if (ctx.scene.infinite_lights.empty()) return;
  if (Rgb* owner = owner_of_lamp(ctx, path, light))
    *owner += path.beta * (path.specular ? escaped(ctx.scene, ray)
                                         : escaped_weighted(ctx.scene, path.ref, ray, path.pdf));
}

// Light that arrives at y, at least the second non-specular point, and is scattered along the path.
Rgb arriving(const RenderContext& ctx, const ShadingPoint& y, Sampler& sampler, TileCounters& counters) {
  Rgb sum = sample_direct(ctx, y, LightWeight::kMis, sampler, counters);
  if (caustics_by_map(ctx))
    sum += photon::estimate_radiance(ctx.maps.caustic.map, y.si, y.wo, *y.bsdf, ctx.maps.caustic.estimate,
                                     counters.gather);
  return sum;
}

// Follows the path through a scattering event; false where it ends.
bool continue_path(const ShadingPoint& v, PathState* path, Ray* ray, Sampler& sampler) {
  const auto s = scatter(v, sampler);
  if (!s || is_black(s->weight)) return false;
  path->beta *= s->weight;
  if (!s->transmission) path->roulette *= max_component(s->weight);
  path->specular = s->specular;
  if (!s->specular) {
    path->ref = v.receiver();
    path->pdf = s->pdf;
  }
  *ray = v.si.spawn(s->wi);
  return true;
}

// Pharr et al. 2023, section 13.2.2, with the refractions' eta^2 left out: radiance is larger in water, but
// not more important. False where the path ends. Draws one dimension.
bool survives(PathState* path, Sampler& sampler) {
  const float u = sampler.next_1d();
  if (path->diffuse < 3 || path->roulette >= 1) return true;
  const float q = std::max(path->roulette, 0.05f);
  if (u >= q) return false;
  path->beta /= q;
  path->roulette /= q;
  return true;
}

}  // namespace

bool traces_paths(const EstimatorPlan& plan) {
  return plan.caustics == CausticEstimator::kPaths || plan.indirect == IndirectEstimator::kPaths;
}

PathLight trace_path(const RenderContext& ctx, const ShadingPoint& x, Sampler& sampler,
                     TileCounters& counters) {
  PathLight light;
  PathState path;
  Ray ray;
  if (!continue_path(x, &path, &ray, sampler)) return light;
  while (true) {
    ++counters.rays.bounce;
    SurfaceInteraction si;
    if (!ctx.bvh.intersect(ray, &si)) {
      add_escape(ctx, path, ray, &light);
      return light;
    }
    add_lamp(ctx, path, si, ray, &light);
    if (++path.events > ctx.settings.max_bounces) return light;
    const ShadingPoint y(ctx.scene, si, -ray.d);
    if (!y.specular()) {
      if (!follows_indirect(ctx)) return light;
      ++path.diffuse;
      light.indirect += path.beta * arriving(ctx, y, sampler, counters);
      if (!survives(&path, sampler)) return light;
    }
    if (!continue_path(y, &path, &ray, sampler)) return light;
  }
}

}  // namespace kaustik::render
