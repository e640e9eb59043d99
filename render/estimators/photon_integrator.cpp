// Radiance along a camera ray:
//
//   L(ray) = Le + Lr                                          the rendering equation (Kajiya 1986)
//   Le: emission seen along the specular chain from the eye   L S* E                    trace_camera_ray
//   In media, light that they emit along the chain is added to Le, and what they scatter to Lr
//                                                             CameraPath::pass_medium
//   Lr = direct + caustic + indirect at points x of the chain, by their diffuse lobes; the chain ends at a
//        point that has no specular lobes
//        direct    L D S* E                 light samples, photons or both                   add_direct
//        caustic   L S+ D S* E              photons or paths                                add_reflected
//        indirect  L S* D (S|D)* D S* E     photons or paths                                add_reflected
//
// Each class has one owner, so that their sum counts every path once (notation: Heckbert 1990).

#include "render/estimators/photon_integrator.h"

#include <array>
#include <memory>

#include "accel/media_walk.h"
#include "render/estimators/glossy_tails.h"
#include "render/estimators/point_plan.h"
#include "render/estimators/scattered_light.h"

namespace kaustik::render {

namespace {

// Adds radiance estimates from photon maps, either at once or when the batch is flushed.
struct MapEstimator {
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
  void add(const GatherMap& gather, const ShadingPoint& x, const Rgb& weight, Rgb* to) const {
    add(gather.map, gather.estimate, x, weight, to);
  }
};

// The lecture's method (TNCG15): photons where the octree cell of x is free of shadow photons, shadow rays
// elsewhere.
bool lecture_trusts_photons(const RenderContext& ctx, const ShadingPoint& x, LectureCounters& counters) {
  const auto answer = photon::lecture_lookup(ctx.maps.direct.map, ctx.maps.shadow, x.si.p, ctx.maps.lecture);
  counters.from_photons += answer.use_photons();
  counters.climbed += answer.outcome == photon::LectureOutcome::kClimbed;
  counters.fallback_few += answer.outcome == photon::LectureOutcome::kFew;
  counters.fallback_shadow += answer.outcome == photon::LectureOutcome::kShadow;
  counters.fallback_face += answer.outcome == photon::LectureOutcome::kFace;
  return answer.use_photons();
}

// Adds beta times the direct light at x.
void add_direct(const RenderContext& ctx, const ShadingPoint& x, const Rgb& beta, LightWeight weight,
                Sampler& sampler, const MapEstimator& maps) {
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
  *to += beta * sample_direct(ctx, x, weight, sampler, maps.counters);
}

// How far paths may be followed for what media emit. Samples that leave out the photons have direct light
// only.
PathReach reach_for_media(const CameraSample& sample) {
  return sample.light == SampleLight::kTraced ? PathReach::kLights : PathReach::kRoulette;
}

// Adds the light that the diffuse lobes of x scatter, seen through a specular chain of throughput beta. Paths
// add nothing to a class that another estimator accounts for.
void add_reflected(const RenderContext& ctx, const ShadingPoint& x, const Rgb& beta, Sampler& sampler,
                   const MapEstimator& maps) {
  PixelResult* const result = maps.result;
  PointPlan point = plan_point(ctx, x);
  const bool traced_only = maps.sample.light == SampleLight::kTraced;
  if (traced_only) point = {false, std::min(point.path, PathReach::kLights)};
  // When a path leaves x anyway, it finds lights too, and shares the direct light with the light samples.
  const bool shared = samples_lights(ctx.plan.direct) && point.path != PathReach::kNone;
  add_direct(ctx, x, beta, shared ? LightWeight::kMis : LightWeight::kAlone, sampler, maps);
  if (!traced_only) {
    if (reads_caustic_photons(ctx.plan)) maps.add(ctx.maps.caustic, x, beta, &result->caustic);
    if (point.indirect_disc) maps.add(ctx.maps.indirect, x, beta, &result->indirect);
  }
  const PathLight path =
      trace_paths(ctx, x, point.path, reach_for_media(maps.sample), sampler, maps.counters);
  result->direct += beta * path.direct;
  result->caustic += beta * path.caustic;
  result->indirect += beta * path.indirect;
}

void set_features(const ShadingPoint& hit, const Rgb& rho, const Point3& eye, PixelResult* result) {
  result->albedo = rho;
  result->normal = hit.si.ns;
  result->depth = glm::distance(hit.si.p, eye);
}

// Chains of more delta lobes than this are cut for features: what is seen after so many is small.
constexpr int kMostFollowed = 8;

// Adds the features of what a chain of delta lobes shows, weighted by its throughput. rho: the albedo at its
// end. length: of the chain.
void add_denoising_features(const ShadingPoint& end, const Rgb& rho, const Rgb& beta, float share,
                            float length, PixelResult* result) {
  // Radiance is larger in a denser medium, albedos are not.
  result->denoising_albedo += glm::min(beta, Rgb(share)) * rho;
  result->denoising_normal += share * end.si.ns;
  result->denoising_depth += share * length;
}

// How the camera ray left its previous point: by a delta lobe, or by a glossy lobe with density pdf.
struct LastScatter {
  bool glossy = false;
  LightReceiver ref;
  float pdf = 0;
};

// One branch of the tree of specular chains that a camera sample traces, at the start of its ray.
struct Branch {
  Ray ray;
  RayCone cone;
  Rgb beta{1};
  float share = 1;  // share of the sample: the product of the Fresnel factors where it was split
  int events = 0;
  LastScatter last{};
  Tail tail = Tail::kNone;
  float length = 0;              // of the chain
  bool shown = false;            // the chain had a point with lobes that are no delta lobes
  MediumIndex medium = kVacuum;  // of the ray
  bool dispersed = false;        // its light has only the sample's wavelength
};

// Emission that the ray meets. After a glossy lobe it has the MIS weight of BSDF sampling, since lights are
// sampled at glossy lobes too.
Rgb emission_seen(const Scene& scene, const LastScatter& last, const SurfaceInteraction& si,
                  const Vector3& d) {
  const Rgb Le = emitted(scene, si, -d);
  if (!last.glossy || is_black(Le)) return Le;
  return Le * emitter_hit_weight(scene, last.ref, d, last.pdf, si);
}
Rgb escape_seen(const RenderContext& ctx, const LastScatter& last, const Ray& ray,
                const LightShares& shares) {
  return last.glossy ? escaped_weighted(ctx, last.ref, ray, last.pdf, shares)
                     : escaped(ctx.scene, ray, shares);
}

// Russian roulette for chains over coated surfaces whose throughput is below kDim: they soon contribute
// little, while each of their points takes a gather. Draws a dimension only then.
bool survives_coats(Rgb* beta, Sampler& sampler) {
  constexpr float kDim = 0.05f;
  const float q = max_component(*beta) / kDim;
  if (q >= 1) return true;
  if (!(sampler.next_1d() < q)) return false;
  *beta /= q;
  return true;
}

// Russian roulette: returns the weight 1 / q with probability q, otherwise 0. Draws a dimension only for q
// < 1.
float roulette_weight(float q, Sampler& sampler) {
  if (q >= 1) return 1;
  return sampler.next_1d() < q ? 1 / q : 0;
}

// Probability of the gather at the end of a branch: that of a dim one costs as much as that of a bright one.
float gather_probability(float share) {
  constexpr float kBright = 0.25f;
  return std::min(share / kBright, 1.0f);
}

// Share of the samples that gather in the tails of glossy lobes. A gather takes as long as the rest of the
// sample, and the samples of a pixel differ little in it.
constexpr float kTailGathers = 0.25f;

// Traces one camera sample through all branches of its specular chains.
class CameraPath {
 public:
  CameraPath(const RenderContext& ctx, const CameraSample& sample, Sampler& sampler, TileCounters& counters,
             PixelResult* result)
      : ctx_(ctx),
        sampler_(sampler),
        counters_(counters),
        result_(result),
        maps_{{sample, counters, result},
              {sample, counters, sample.dispersed ? &sample.dispersed->light : nullptr}} {
    if (!ctx.scene.needs.dispersion) return;
    wavelength_ = sample.dispersed->wavelength = sample_wavelength(sampler.next_1d());
  }

  void trace(const CameraSample& sample) {
    ++counters_.rays.camera;
    Branch first{sample.ray, ctx_.cone};
    first.medium = ctx_.scene.camera_medium;
    visit(first, sample.hit);
    while (waiting_ > 0) {
      Branch branch = branches_[--waiting_];
      ++counters_.rays.specular;
      visit(branch, ctx_.bvh.intersect(branch.ray));
    }
  }

 private:
  // Most branches that wait at a time. Each split leaves one waiting.
  static constexpr int kMostWaiting = 16;

  // Adds the light at the end of a branch and continues the branch if the surface has specular lobes.
  void visit(Branch& branch, const Hit& hit) {
    if (branch.medium != kVacuum || ctx_.scene.interfaces)
      pass_media(branch, hit.valid() ? hit.t : kInfinity);
    const LightShares shares = shares_seen(branch);
    if (!hit.valid()) {
      if (shares.all > 0) add_emission(branch, escape_seen(ctx_, branch.last, branch.ray, shares));
      return;
    }
    const Vector3 wo = -branch.ray.d;
    const SurfaceInteraction si = make_interaction(ctx_.scene.shapes, branch.ray, hit);
    if (shares.all > 0 && si.light != kNoIndex)
      add_emission(
          branch, shares.of(si.light, branch.ray) * emission_seen(ctx_.scene, branch.last, si, branch.ray.d));
    const RayCone cone = branch.cone.after(hit.t);
    const bool constant = ctx_.scene.materials[si.material].constant();
    ShadingPoint x(ctx_.scene, si, wo, constant ? Footprint{} : cone.on_surface(branch.ray.d, si.n),
                   wavelength_);
    branch.dispersed |= scatters_one_wavelength(*x.bsdf);
    x.medium = branch.medium, x.wavelength = wavelength_of(branch);
    const Lobes parts = lobes(*x.bsdf);
    const float length = branch.length + hit.t;
    const bool end = parts.diffuse || parts.glossy || !parts.specular || branch.events == kMostFollowed;
    const bool first = branch.events == 0, last = end && !branch.shown;
    if (first || last) {
      const Rgb rho = albedo(*x.bsdf);
      if (first) set_features(x, rho, branch.ray.o, result_);
      if (last) add_denoising_features(x, rho, branch.beta, branch.share, length, result_);
    }
    if (parts.diffuse)
      if (const float weight = roulette_weight(gather_probability(branch.share), sampler_); weight > 0)
        add_reflected(ctx_, x, weight * branch.beta, sampler_, maps_of(branch));
    if (!parts.specular || branch.events == ctx_.settings.max_bounces) return;
    if (parts.glossy) branch.tail == Tail::kNone ? add_glossy(branch, x) : add_glossy_behind_tail(branch, x);
    const SceneNeeds& needs = ctx_.scene.needs;
    const bool sees_more = needs.diffuse || needs.scattering || needs.emissive_media;
    if (branch.tail != Tail::kNone && !sees_more) return;
    Branch here = branch;
    here.cone = cone, here.length = length, here.shown = branch.shown || end;
    if (parts.glossy || parts.diffuse || !split(here, x)) continue_specular(here, x);
  }

  // The shares of lights that the branch's ray meets which it brings: behind a tail photons bring theirs.
  LightShares shares_seen(const Branch& branch) const {
    return branch.tail == Tail::kBehind ? shares_behind_tail() : LightShares{};
  }
  LightShares shares_behind_tail() const {
    if (ctx_.plan.caustics != CausticEstimator::kSplit) return {0};
    return path_shares_of_lights(ctx_, 1);
  }

  // Adds what media scatter along the branch's ray, and takes away what does not get through.
  void pass_media(Branch& branch, float distance) {
    branch.medium = accel::walk_media(
        ctx_.bvh.interfaces(), branch.ray, distance, branch.medium,
        [&](MediumIndex medium, float begin, float end) {
          pass_medium(branch,
                      {{branch.ray.at(begin), branch.ray.d}, end - begin, medium, wavelength_of(branch)});
          return true;
        });
  }
  void pass_medium(Branch& branch, const Beam& beam) {
    const MapEstimator& maps = maps_of(branch);
    const PathLight light = scattered_light(ctx_, beam, branch.beta, maps.sample.light,
                                            reach_for_media(maps.sample), sampler_, counters_);
    const auto add = [&](const Rgb& of_class, Rgb* all, Rgb* of_media) {
      *all += branch.beta * of_class;
      *of_media += branch.beta * of_class;
    };
    PixelResult* const to = maps.result;
    add(light.direct, &to->direct, &to->media_direct);
    add(light.caustic, &to->caustic, &to->media_caustic);
    add(light.indirect, &to->indirect, &to->media_indirect);
    const Medium& medium = ctx_.scene.media[beam.medium];
    const float column = column_of(medium, beam.ray, 0, beam.distance);
    if (medium.emits()) add_emission(branch, emitted_radiance(medium, column));
    branch.beta *= transmittance(medium, column);
  }

  void add_emission(const Branch& branch, const Rgb& Le) {
    PixelResult* const result = maps_of(branch).result;
    result->emitted += branch.beta * Le;
    if (branch.events > 0) result->denoising_emitted += branch.beta * Le;
  }

  // Adds the light that the glossy lobes of x scatter straight from lights, and in their tails from the
  // caustic map.
  void add_glossy(const Branch& branch, const ShadingPoint& x) {
    Rgb light = sample_direct(ctx_, x, LightWeight::kMis, sampler_, counters_, LobePart::kGlossy);
    if (gathers_tail(ctx_, x)) {
      const float q = kTailGathers * gather_probability(branch.share);
      if (const float weight = roulette_weight(q, sampler_); weight > 0)
        light +=
            weight * photon::estimate_glossy_tail(ctx_.maps.caustic.map, x.si, x.wo, *x.bsdf,
                                                  ctx_.maps.caustic.estimate, kTailPdf, counters_.gather);
    }
    add_glossy(branch, light);
  }
  // The share of paths in the light that the glossy lobes of x scatter straight from lights, where a tail
  // comes before them.
  void add_glossy_behind_tail(const Branch& branch, const ShadingPoint& x) {
    const LightShares shares = shares_behind_tail();
    if (!(shares.all > 0)) return;
    add_glossy(branch,
               sample_direct(ctx_, x, LightWeight::kMis, sampler_, counters_, LobePart::kGlossy, shares));
  }
  void add_glossy(const Branch& branch, const Rgb& light) {
    PixelResult* const result = maps_of(branch).result;
    result->emitted += branch.beta * light;
    result->denoising_emitted += branch.beta * light;
  }

  // Where the light of a branch is added.
  const MapEstimator& maps_of(const Branch& branch) const { return maps_[branch.dispersed]; }
  float wavelength_of(const Branch& branch) const { return branch.dispersed ? wavelength_ : kNoWavelength; }

  void continue_specular(const Branch& from, const ShadingPoint& x) {
    const auto s = scatter(x, sampler_, Scatter::kSpecular);
    if (!s) return;
    Rgb beta = from.beta * s->weight;
    if (lobes(*x.bsdf).diffuse && !survives_coats(&beta, sampler_)) return;
    Tail tail = behind_event(from.tail);
    if (tail == Tail::kNone && s->glossy && gathers_tail(ctx_, x) && in_tail(x, s->wi)) tail = Tail::kLeft;
    push({x.si.spawn(s->wi), from.cone, beta, from.share, from.events + 1,
          LastScatter{s->glossy, x.receiver(), s->pdf}, tail, from.length, from.shown,
          medium_towards(ctx_.scene, x, s->wi),
          from.dispersed || selects_wavelength(*x.bsdf, x.wo_local, *s)});
  }

  // Splits the branch in a reflected and a refracted ray, weighted by their Fresnel factors. Choosing one at
  // random instead makes the faint reflection of a light in glass noisy. Returns false and does nothing where
  // there are not two such rays or the dimmer of them is below kDim.
  bool split(const Branch& from, const ShadingPoint& x) {
    constexpr float kDim = 1.0f / 256;
    if (waiting_ + 2 > kMostWaiting) return false;
    const auto reflected = scatter_delta(x, 0), refracted = scatter_delta(x, kOneMinusEpsilon);
    if (!reflected || !refracted || reflected->transmission == refracted->transmission) return false;
    if (from.share * std::min(reflected->pdf, refracted->pdf) < kDim) return false;
    for (const BsdfSample* s : {&*reflected, &*refracted})
      push({x.si.spawn(s->wi), from.cone, from.beta * s->weight * s->pdf, from.share * s->pdf,
            from.events + 1, LastScatter{false, x.receiver(), s->pdf}, behind_event(from.tail), from.length,
            from.shown, medium_towards(ctx_.scene, x, s->wi),
            from.dispersed || selects_wavelength(*x.bsdf, x.wo_local, *s)});
    return true;
  }

  void push(const Branch& branch) { std::construct_at(&branches_[static_cast<size_t>(waiting_++)], branch); }

  const RenderContext& ctx_;
  Sampler& sampler_;
  TileCounters& counters_;
  PixelResult* result_;
  MapEstimator maps_[2];  // of light before and after dispersive glass has refracted it
  float wavelength_ = kNoWavelength;
  // Not initialised: most samples use few of them.
  static_assert(std::is_trivially_destructible_v<Branch>);
  union {
    std::array<Branch, kMostWaiting> branches_;
  };
  int waiting_ = 0;
};

}  // namespace

void DispersedLight::add_to(PixelResult* sample) const {
  const auto add = [&](const Rgb& part, Rgb* to) {
    if (!is_black(part)) *to += at_wavelength(part, wavelength);
  };
  add(light.emitted, &sample->emitted);
  add(light.direct, &sample->direct);
  add(light.caustic, &sample->caustic);
  add(light.indirect, &sample->indirect);
  add(light.denoising_emitted, &sample->denoising_emitted);
  add(light.bias, &sample->bias);
  add(light.media_direct, &sample->media_direct);
  add(light.media_caustic, &sample->media_caustic);
  add(light.media_indirect, &sample->media_indirect);
  sample->photons += light.photons;
}

void trace_camera_ray(const RenderContext& ctx, const CameraSample& sample, Sampler& sampler,
                      TileCounters& counters, PixelResult* result) {
  CameraPath(ctx, sample, sampler, counters, result).trace(sample);
}

}  // namespace kaustik::render
