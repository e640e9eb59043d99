#pragma once
// One photon's life: from lamp to absorption, leaving records on non-specular surfaces.
//
// Path classes (Heckbert 1990; Jensen 2001, chapter 5; Jensen and Christensen 1995 for shadow photons):
//   direct    L D            at the first surface, if it is non-specular
//   shadow    L D ...        where the direct photon's straight ray, continued through the scene, meets each
//                            further non-specular surface, until it leaves the scene
//   caustic   L S+ D         at the first non-specular surface after specular ones
//   indirect  L (S|D)* D (S|D)* D
// A path whose first surface is specular leaves neither direct nor shadow photons.
//
// Not handled: participating media; specular surfaces cast no shadow photons of their own, and a straight ray
// passes through them.

#include <array>
#include <cmath>
#include <cstdint>
#include <variant>

#include "accel/bvh.h"
#include "photon/emission.h"
#include "photon/photon.h"

namespace kaustik::photon {

struct KindMask {
  bool direct = false, shadow = false, caustic = false, indirect = false;
  bool operator[](PhotonKind k) const {
    const bool kinds[] = {direct, shadow, caustic, indirect};
    return kinds[static_cast<int>(k)];
  }
  bool any() const { return direct || shadow || caustic || indirect; }
};

struct TraceSettings {
  uint64_t seed = 0;
  uint64_t pass = 0;
  uint64_t photons = 0;  // emitted in this pass
  // Longest path L x1 ... xj whose photon at xj is kept: j <= max_bounces. The deposit counts as a scattering
  // (it sends light to the eye): 1 is direct light alone, 2 adds one reflection before the deposit.
  int max_bounces = 16;
  EmissionMode emission = EmissionMode::kCosine;
  KindMask kinds;  // only what is asked for is traced: without `indirect` a photon ends at its first diffuse
                   // surface
};

// Exact counters, merged by integer sums.
struct TraceCounters {
  uint64_t emitted = 0;
  uint64_t rays = 0;         // path segments traced
  uint64_t shadow_rays = 0;  // segments of straight paths behind the first surface
  std::array<uint64_t, kPhotonKinds> stored{};
  uint64_t dropped_invalid = 0;  // NaN, infinite or negative flux
  TraceCounters& operator+=(const TraceCounters& o);
};

// Key of the random sequence of a pass: independent of those of the camera paths.
uint64_t photon_stream(const TraceSettings& settings);

// Dimensions of a photon's random point: emission has the first 8, each vertex the next 4.
inline constexpr uint32_t kEmissionDimensions = 8;
inline constexpr uint32_t kVertexDimensions = 4;

// A straight ray leaves at most so many shadow photons: no scene in use comes near.
inline constexpr int kMaxStraightSurfaces = 1 << 16;

namespace detail {

inline bool is_valid_flux(const Rgb& flux) {
  return is_finite(flux) && flux.x >= 0 && flux.y >= 0 && flux.z >= 0;
}

// Shading normals. With ns the camera path's measurement is defined as (Veach 1997, section 5.3)
//   Lo(wo) = integral f(wo, wi) Li(wi) |wi.ns| dwi,
// while photons that cross the geometric surface from wi bring the flux dPhi = Li |wi.n| dwi dA. Hence
//   Lo(wo) = 1/dA sum f(wo, wi) dPhi c(wi)   with   c(w) = |w.ns| / |w.n|,
// so a deposit carries c(wi). A photon that goes on in wi carries Lo(wi) |wi.n| dwi dA: with sample_f's
// weight f |wi.ns| / pdf the factor left is c(wo) / c(wi), where wo points back to where the photon came
// from. Both hold for delta lobes too, whose f has 1/|wi.ns|. Directions on different sides of n and ns carry
// nothing (no light leaks), as on camera paths.
//
// cos_ns = w.ns. Returns c(w), zero when the sides differ; exactly one when ns equals n.
inline float shading_correction(const SurfaceInteraction& si, const Vector3& w, float cos_ns) {
  const float cos_n = glm::dot(w, si.n);
  if (!(cos_n * cos_ns > 0)) return 0;
  return si.n == si.ns ? 1.0f : cos_ns / cos_n;
}

// Diffuse reflection has one lobe and needs no number to choose it.
template <class B>
inline constexpr bool kChoosesLobe = !std::is_same_v<B, Lambertian> && !std::is_same_v<B, OrenNayar>;

// One Newton step towards length 1, for directions whose length is off by rounding: keeps long specular
// chains from drifting, without a division.
inline Vector3 unit(const Vector3& w) {
  return (1.5f - 0.5f * length_squared(w)) * w;
}

// One photon between vertices: the ray that it is about to follow, and what it has met.
struct Walk {
  uint64_t index = 0;
  Ray ray;
  Rgb flux{0};
  int vertex = 1;  // that the ray leads to
  bool met_specular = false, met_diffuse = false;

  bool is_direct() const { return !met_specular && !met_diffuse; }
  PhotonKind kind() const {
    if (met_diffuse) return PhotonKind::kIndirect;
    return met_specular ? PhotonKind::kCaustic : PhotonKind::kDirect;
  }
};

// What all photons of a shoot share.
template <class Accel, class Sink>
class Tracer {
 public:
  Tracer(const Scene& scene, const Accel& bvh, const TraceSettings& settings, Sink& sink,
         TraceCounters& counters)
      : scene_(scene),
        bvh_(bvh),
        settings_(settings),
        sink_(sink),
        counters_(counters),
        stream_(photon_stream(settings)) {}

  // Emits photon `index`; false when it has nothing to carry.
  bool start(uint64_t index, Walk* walk) {
    ++counters_.emitted;
    Sampler sampler(stream_, index);
    const auto sample = emit_photon(scene_, sampler, settings_.photons, settings_.emission);
    if (!sample || settings_.max_bounces < 1) return false;
    *walk = Walk{index, sample->ray, sample->flux};
    return !is_black(walk->flux) && valid(walk->flux);
  }

  Hit next_hit(const Walk& walk) {
    ++counters_.rays;
    return bvh_.intersect(walk.ray);
  }

  // At the vertex: deposit, then scatter. False when the photon's life ends here.
  bool arrive(const Hit& hit, Walk* walk) {
    if (!hit.valid()) return false;
    const SurfaceInteraction si = make_interaction(scene_.shapes, walk->ray, hit);
    return std::visit([&](const auto& bsdf) { return interact(bsdf, si, *walk); }, scene_.bsdf(si));
  }

 private:
  // Counts and refuses what must never reach a map.
  bool valid(const Rgb& flux) {
    if (is_valid_flux(flux)) return true;
    ++counters_.dropped_invalid;
    return false;
  }

  void record(PhotonKind kind, const SurfaceInteraction& si, const Walk& walk) {
    const Vector3 wi = -walk.ray.d;
    const Rgb deposit = shading_correction(si, wi, glm::dot(wi, si.ns)) * walk.flux;
    if (is_black(deposit) || !valid(deposit)) return;
    ++counters_.stored[static_cast<size_t>(kind)];
    sink_(kind, Photon{si.p, wi, deposit, glm::dot(wi, si.n) < 0 ? -si.n : si.n, si.surface_group});
  }

  // The straight ray behind the first surface.
  void leave_shadows(SurfaceInteraction si, const Walk& walk) {
    for (int i = 0; i < kMaxStraightSurfaces; ++i) {
      ++counters_.shadow_rays;
      const Ray ray = si.spawn(walk.ray.d);
      const Hit hit = bvh_.intersect(ray);
      if (!hit.valid()) return;
      si = make_interaction(scene_.shapes, ray, hit);
      if (!is_specular(scene_.bsdf(si))) record(PhotonKind::kShadow, si, walk);
    }
  }

  template <class B>
  bool interact(const B& bsdf, const SurfaceInteraction& si, Walk& walk) {
    const KindMask& kinds = settings_.kinds;
    if constexpr (B::kSpecular) {
      if (!kinds.caustic && !kinds.indirect) return false;
      walk.met_specular = true;
    } else {
      if (kinds[walk.kind()]) record(walk.kind(), si, walk);
      if (walk.is_direct() && kinds.shadow) leave_shadows(si, walk);
      if (!kinds.indirect) return false;
      walk.met_diffuse = true;
    }
    return walk.vertex < settings_.max_bounces && scatter(bsdf, si, walk);
  }

  // Samples the next direction and plays Russian roulette; false when the photon is absorbed.
  template <class B>
  bool scatter(const B& bsdf, const SurfaceInteraction& si, Walk& walk) {
    // Dimensions of the vertex: direction (0, 1), lobe (2), roulette (3); a delta lobe needs no direction.
    const uint32_t before = kEmissionDimensions + kVertexDimensions * static_cast<uint32_t>(walk.vertex - 1);
    Sampler sampler(stream_, walk.index, before + 2 * B::kSpecular);
    const Point2 u = B::kSpecular ? Point2(0) : sampler.next_2d();
    const float u_lobe = kChoosesLobe<B> ? sampler.next_1d() : 0;
    const Frame frame = Frame::from_z(si.ns);
    const Vector3 wo = -walk.ray.d;
    const Vector3 wo_local = frame.to_local(wo);
    const auto sample = bsdf.sample_f(wo_local, u_lobe, u, TransportMode::kImportance);
    if (!sample) return false;
    const Vector3 wi = unit(frame.to_world(sample->wi));
    const float c_out = shading_correction(si, wi, sample->wi.z);
    if (c_out == 0) return false;
    const Rgb next = sample->weight * (shading_correction(si, wo, wo_local.z) / c_out) * walk.flux;
    if (is_black(next) || !valid(next) || !survive(next, sampler, walk)) return false;
    walk.ray = si.spawn(wi);
    ++walk.vertex;
    return true;
  }

  // Roulette: survival with probability q = min(1, next / flux) keeps the flux of the survivors near
  // constant.
  static bool survive(const Rgb& next, Sampler& sampler, Walk& walk) {
    const float before = max_component(walk.flux), after = max_component(next);
    if (!(after < before)) {
      walk.flux = next;
      return true;
    }
    walk.flux = (before / after) * next;
    return sampler.next_1d() * before < after;
  }

  const Scene& scene_;
  const Accel& bvh_;
  const TraceSettings& settings_;
  Sink& sink_;
  TraceCounters& counters_;
  const uint64_t stream_;
};

// A hit names a triangle; its vertices lie two dependent loads away, often out of cache. Asking for all of a
// group's before any is needed hides most of that wait.
inline void prefetch_indices(const Scene& scene, const Hit& hit) {
  if (!hit.valid()) return;
  const auto* mesh = std::get_if<TriangleMesh>(&scene.shapes[hit.shape].geometry);
  if (mesh) __builtin_prefetch(&mesh->indices[hit.primitive]);
}
inline void prefetch_vertices(const Scene& scene, const Hit& hit) {
  if (!hit.valid()) return;
  const auto* mesh = std::get_if<TriangleMesh>(&scene.shapes[hit.shape].geometry);
  if (!mesh) return;
  for (uint32_t vertex : mesh->indices[hit.primitive]) {
    __builtin_prefetch(&mesh->P[vertex]);
    if (!mesh->N.empty()) __builtin_prefetch(&mesh->N[vertex]);
  }
}

}  // namespace detail

// Photons that walk side by side.
inline constexpr uint64_t kGroupSize = 16;

// Traces photons first ... end - 1 of settings.photons and calls sink(PhotonKind, const Photon&) for each
// photon of a kind in settings.kinds. Photons walk in groups of kGroupSize counted from `first`, a vertex of
// each in turn: that is the order of the calls. What a photon leaves is a pure function of (scene, settings,
// index), save that a kind that is not asked for may shorten its path: the photons of the other kinds do not
// change. Photons without flux are not handed over; those of invalid flux are counted. counters are added to.
// Accel: accel::Bvh or anything with its Hit intersect(const Ray&) const. Thread-safe.
template <class Accel, class Sink>
void trace_photons(const Scene& scene, const Accel& bvh, const TraceSettings& settings, uint64_t first,
                   uint64_t end, Sink&& sink, TraceCounters& counters) {
  detail::Tracer<Accel, std::remove_reference_t<Sink>> tracer(scene, bvh, settings, sink, counters);
  std::array<detail::Walk, kGroupSize> walks;
  std::array<Hit, kGroupSize> hits;
  for (uint64_t group = first; group < end; group += kGroupSize) {
    size_t alive = 0;
    for (uint64_t i = group; i < std::min(end, group + kGroupSize); ++i)
      alive += tracer.start(i, &walks[alive]);
    while (alive > 0) {
      for (size_t k = 0; k < alive; ++k) {
        hits[k] = tracer.next_hit(walks[k]);
        detail::prefetch_indices(scene, hits[k]);
      }
      for (size_t k = 0; k < alive; ++k) detail::prefetch_vertices(scene, hits[k]);
      size_t going_on = 0;
      for (size_t k = 0; k < alive; ++k) {
        if (tracer.arrive(hits[k], &walks[k])) walks[going_on++] = walks[k];
      }
      alive = going_on;
    }
  }
}

// One photon: trace_photons of index alone.
template <class Accel, class Sink>
void trace_photon(const Scene& scene, const Accel& bvh, const TraceSettings& settings, uint64_t index,
                  Sink&& sink, TraceCounters& counters) {
  trace_photons(scene, bvh, settings, index, index + 1, sink, counters);
}

}  // namespace kaustik::photon
