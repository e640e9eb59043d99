// What a camera ray brings back:
//
//   L(ray) = Le + Lr                                          the rendering equation (Kajiya 1986)
//   Le: emission seen along the specular chain from the eye   L S* E                    trace_camera_ray
//   Lr = direct + caustic + indirect at points x of the chain, by their broad lobes; where all lobes of a
//        point are broad, the chain ends
//        direct    L D S* E                 lamp samples, photons or both                   direct_light
//        caustic   L S+ D S* E              photons or paths                                caustic_light
//        indirect  L S* D (S|D)* D S* E     photons or paths                                indirect_light
//
// Each class has one owner, so that their sum counts every path once (Heckbert 1990 for the notation).

#include "render/photon_integrator.h"

#include "render/path_integrator.h"

namespace kaustik::render {

namespace {

// bias: null where it is not asked for.
Rgb from_map(const photon::PhotonMap& map, const photon::EstimateSettings& estimate, const ShadingPoint& x,
             TileCounters& counters, photon::BiasEstimate* bias) {
  return photon::estimate_radiance(map, x.si, x.wo, *x.bsdf, estimate, counters.gather, bias);
}

Rgb from_map(const ReadMap& read, const ShadingPoint& x, TileCounters& counters, photon::BiasEstimate* bias) {
  return from_map(read.map, read.estimate, x, counters, bias);
}

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

// Too bright an estimate of it makes the picture too dark.
Rgb blocked_light(const RenderContext& ctx, const ShadingPoint& x, TileCounters& counters,
                  photon::BiasEstimate* bias) {
  photon::BiasEstimate of_blocked;
  const Rgb blocked =
      from_map(ctx.maps.shadow, ctx.maps.direct.estimate, x, counters, bias ? &of_blocked : nullptr);
  if (bias) {
    bias->bias -= of_blocked.bias;
    bias->counters += of_blocked.counters;
  }
  return blocked;
}

// BSDF sampling finds lamps too when a path leaves x anyway: then both share the direct light.
LightWeight light_weight(const EstimatorPlan& plan) {
  return samples_lamps(plan.direct) && traces_paths(plan) ? LightWeight::kMis : LightWeight::kAlone;
}

Rgb direct_light(const RenderContext& ctx, const ShadingPoint& x, Sampler& sampler, TileCounters& counters,
                 photon::BiasEstimate* bias) {
  switch (ctx.plan.direct) {
    case DirectEstimator::kPhotons:
      return from_map(ctx.maps.direct, x, counters, bias);
    case DirectEstimator::kLecture:
      if (lecture_trusts_photons(ctx, x, counters.lecture))
        return from_map(ctx.maps.direct, x, counters, bias);
      break;
    case DirectEstimator::kSigned:
      return unoccluded_direct(ctx, x, sampler) - blocked_light(ctx, x, counters, bias);
    case DirectEstimator::kShadowRays:
    case DirectEstimator::kPredicted:
      break;
  }
  return sample_direct(ctx, x, light_weight(ctx.plan), sampler, counters);
}

Rgb caustic_light(const RenderContext& ctx, const ShadingPoint& x, TileCounters& counters,
                  photon::BiasEstimate* bias) {
  if (ctx.plan.caustics != CausticEstimator::kPhotons) return Rgb(0);
  return from_map(ctx.maps.caustic, x, counters, bias);
}

Rgb indirect_light(const RenderContext& ctx, const ShadingPoint& x, TileCounters& counters,
                   photon::BiasEstimate* bias) {
  if (ctx.plan.indirect != IndirectEstimator::kPhotons) return Rgb(0);
  return from_map(ctx.maps.indirect, x, counters, bias);
}

// Light scattered by the broad lobes of a point, seen through a specular chain of throughput beta. The path
// brings nothing of a class that another estimator owns, so each sum below has one owner.
void add_reflected(const RenderContext& ctx, const ShadingPoint& x, const Rgb& beta, Sampler& sampler,
                   TileCounters& counters, bool with_bias, PixelResult* result) {
  const uint64_t accepted = counters.gather.accepted;
  photon::BiasEstimate measured;
  photon::BiasEstimate* const bias = with_bias ? &measured : nullptr;
  const Rgb direct = direct_light(ctx, x, sampler, counters, bias);
  const Rgb caustic = caustic_light(ctx, x, counters, bias);
  const Rgb indirect = indirect_light(ctx, x, counters, bias);
  result->photons += float(counters.gather.accepted - accepted);
  result->bias += beta * measured.bias;
  counters.gather += measured.counters;
  const PathLight path = traces_paths(ctx.plan) ? trace_path(ctx, x, sampler, counters) : PathLight{};
  result->direct += beta * (direct + path.direct);
  result->caustic += beta * (caustic + path.caustic);
  result->indirect += beta * (indirect + path.indirect);
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

PixelResult trace_camera_ray(const RenderContext& ctx, const Ray& camera_ray, const Hit& first,
                             Sampler& sampler, TileCounters& counters, bool with_bias) {
  PixelResult result;
  Rgb beta(1);
  Ray ray = camera_ray;
  Hit hit = first;
  LeftBy last;
  ++counters.rays.camera;
  for (int events = 0;; ++events) {
    if (!hit.valid()) {
      result.emitted += beta * escape_seen(ctx.scene, last, ray);
      return result;
    }
    const SurfaceInteraction si = make_interaction(ctx.scene.shapes, ray, hit);
    result.emitted += beta * emission_seen(ctx.scene, last, si, ray.d);
    const ShadingPoint x(ctx.scene, si, -ray.d);
    if (events == 0) set_features(x, ray.o, &result);
    const Lobes parts = lobes(*x.bsdf);
    if (parts.broad) add_reflected(ctx, x, beta, sampler, counters, with_bias, &result);
    if (!parts.specular || events == ctx.settings.max_bounces) return result;
    if (parts.glossy)
      result.emitted += beta * sample_direct(ctx, x, LightWeight::kMis, sampler, counters, LobePart::kGlossy);
    const auto s = scatter(x, sampler, Scatter::kSpecular);
    if (!s) return result;
    beta *= s->weight;
    if (parts.broad && !is_worth_it(&beta, sampler)) return result;
    last = {s->glossy, x.receiver(), s->pdf};
    ray = si.spawn(s->wi);
    hit = ctx.bvh.intersect(ray);
    ++counters.rays.specular;
  }
}

}  // namespace kaustik::render
