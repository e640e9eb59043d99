// What a camera ray brings back:
//
//   L(ray) = Le + Lr                                          the rendering equation (Kajiya 1986)
//   Le: emission seen along the specular chain from the eye   L S* E                    trace_camera_ray
//   Lr = direct + caustic + indirect at points x of the chain, by their broad lobes; where all lobes of a
//        point are broad, the chain ends
//        direct    L D S* E                 lamp samples, photons or both                   add_direct
//        caustic   L S+ D S* E              photons or paths                                add_reflected
//        indirect  L S* D (S|D)* D S* E     photons or paths                                add_reflected
//
// Each class has one owner, so that their sum counts every path once (Heckbert 1990 for the notation).

#include "render/photon_integrator.h"

#include "render/path_integrator.h"

namespace kaustik::render {

namespace {

// Adds what a photon map says of a point, at once or when the batch is flushed.
struct MapReader {
  const CameraSample& sample;
  TileCounters& counters;
  PixelResult* result;

  // Adds weight * Lr to *to, which is part of *result.
  void add(const photon::PhotonMap& map, const photon::EstimateSettings& estimate, const ShadingPoint& x,
           const Rgb& weight, Rgb* to) const {
    if (!sample.with_bias &&
        sample.batch->add(map, x.si, x.wo, *x.bsdf, estimate, weight, to, &result->photons))
      return;
    const uint64_t accepted = counters.gather.accepted;
    photon::BiasEstimate bias;
    *to += weight * photon::estimate_radiance(map, x.si, x.wo, *x.bsdf, estimate, counters.gather,
                                              sample.with_bias ? &bias : nullptr);
    result->photons += float(counters.gather.accepted - accepted);
    result->bias += weight * bias.bias;
    counters.gather += bias.counters;
  }
  void add(const ReadMap& read, const ShadingPoint& x, const Rgb& weight, Rgb* to) const {
    add(read.map, read.estimate, x, weight, to);
  }
};

// The lecture (TNCG15): photons where the octree cell of x is free of shadow photons, shadow rays elsewhere.
bool lecture_trusts_photons(const RenderContext& ctx, const ShadingPoint& x, LectureCounters& counters) {
  const auto answer = photon::lecture_lookup(ctx.maps.direct.map, ctx.maps.shadow, x.si.p, ctx.maps.lecture);
  counters.from_photons += answer.use_photons();
  counters.climbed += answer.outcome == photon::LectureOutcome::kClimbed;
  counters.fallback_few += answer.outcome == photon::LectureOutcome::kFew;
  counters.fallback_shadow += answer.outcome == photon::LectureOutcome::kShadow;
  counters.fallback_face += answer.outcome == photon::LectureOutcome::kFace;
  return answer.use_photons();
}

// BSDF sampling finds lamps too when a path leaves x anyway: then both share the direct light.
LightWeight light_weight(const EstimatorPlan& plan) {
  return samples_lamps(plan.direct) && traces_paths(plan) ? LightWeight::kMis : LightWeight::kAlone;
}

// Adds beta times the direct light at x.
void add_direct(const RenderContext& ctx, const ShadingPoint& x, const Rgb& beta, Sampler& sampler,
                const MapReader& maps) {
  Rgb* const to = &maps.result->direct;
  switch (ctx.plan.direct) {
    case DirectEstimator::kPhotons:
      return maps.add(ctx.maps.direct, x, beta, to);
    case DirectEstimator::kLecture:
      if (lecture_trusts_photons(ctx, x, maps.counters.lecture))
        return maps.add(ctx.maps.direct, x, beta, to);
      break;
    case DirectEstimator::kSigned:
      *to += beta * unoccluded_direct(ctx, x, sampler);
      return maps.add(ctx.maps.shadow, ctx.maps.direct.estimate, x, -beta, to);
    case DirectEstimator::kShadowRays:
    case DirectEstimator::kPredicted:
      break;
  }
  *to += beta * sample_direct(ctx, x, light_weight(ctx.plan), sampler, maps.counters);
}

// Light scattered by the broad lobes of a point, seen through a specular chain of throughput beta. The path
// brings nothing of a class that another estimator owns, so each sum has one owner.
void add_reflected(const RenderContext& ctx, const ShadingPoint& x, const Rgb& beta, Sampler& sampler,
                   const MapReader& maps) {
  PixelResult* const result = maps.result;
  add_direct(ctx, x, beta, sampler, maps);
  if (ctx.plan.caustics == CausticEstimator::kPhotons) maps.add(ctx.maps.caustic, x, beta, &result->caustic);
  if (ctx.plan.indirect == IndirectEstimator::kPhotons)
    maps.add(ctx.maps.indirect, x, beta, &result->indirect);
  if (!traces_paths(ctx.plan)) return;
  const PathLight path = trace_path(ctx, x, sampler, maps.counters);
  result->direct += beta * path.direct;
  result->caustic += beta * path.caustic;
  result->indirect += beta * path.indirect;
}

void set_features(const ShadingPoint& hit, const Point3& eye, PixelResult* result) {
  result->albedo = albedo(*hit.bsdf);
  result->normal = hit.si.ns;
  result->depth = glm::distance(hit.si.p, eye);
}

// How a camera ray left the point before: by a delta lobe, or by a glossy one with density pdf.
struct LeftBy {
  bool glossy = false;
  LightReceiver ref;
  float pdf = 0;
};

// Lamps that a glossy lobe leads to are sampled where it is, too.
Rgb emission_seen(const Scene& scene, const LeftBy& last, const SurfaceInteraction& si, const Vector3& d) {
  const Rgb Le = emitted(scene, si, -d);
  if (!last.glossy || is_black(Le)) return Le;
  return Le * emitter_hit_weight(scene, last.ref, d, last.pdf, si);
}
Rgb escape_seen(const Scene& scene, const LeftBy& last, const Ray& ray) {
  return last.glossy ? escaped_weighted(scene, last.ref, ray, last.pdf) : escaped(scene, ray);
}

// Chains over coated surfaces grow dim soon, and each point of them takes a gather: Russian roulette for what
// is less than kDim of the pixel. Draws a dimension there.
bool is_worth_it(Rgb* beta, Sampler& sampler) {
  constexpr float kDim = 0.05f;
  const float q = max_component(*beta) / kDim;
  if (q >= 1) return true;
  if (!(sampler.next_1d() < q)) return false;
  *beta /= q;
  return true;
}

}  // namespace

void trace_camera_ray(const RenderContext& ctx, const CameraSample& sample, Sampler& sampler,
                      TileCounters& counters, PixelResult* result) {
  const MapReader maps{sample, counters, result};
  Rgb beta(1);
  Ray ray = sample.ray;
  Hit hit = sample.hit;
  LeftBy last;
  RayCone cone = ctx.cone;
  ++counters.rays.camera;
  for (int events = 0;; ++events) {
    if (!hit.valid()) {
      result->emitted += beta * escape_seen(ctx.scene, last, ray);
      return;
    }
    const SurfaceInteraction si = make_interaction(ctx.scene.shapes, ray, hit);
    result->emitted += beta * emission_seen(ctx.scene, last, si, ray.d);
    cone = cone.after(hit.t);
    const bool plain = ctx.scene.materials[si.material].constant();
    const ShadingPoint x(ctx.scene, si, -ray.d, plain ? Footprint{} : cone.on_surface(ray.d, si.n));
    if (events == 0) set_features(x, ray.o, result);
    const Lobes parts = lobes(*x.bsdf);
    if (parts.broad) add_reflected(ctx, x, beta, sampler, maps);
    if (!parts.specular || events == ctx.settings.max_bounces) return;
    if (parts.glossy)
      result->emitted +=
          beta * sample_direct(ctx, x, LightWeight::kMis, sampler, counters, LobePart::kGlossy);
    const auto s = scatter(x, sampler, Scatter::kSpecular);
    if (!s) return;
    beta *= s->weight;
    if (parts.broad && !is_worth_it(&beta, sampler)) return;
    last = {s->glossy, x.receiver(), s->pdf};
    ray = si.spawn(s->wi);
    hit = ctx.bvh.intersect(ray);
    ++counters.rays.specular;
  }
}

}  // namespace kaustik::render
