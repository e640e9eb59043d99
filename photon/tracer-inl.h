#pragma once
// How photons walk. Included by tracer.h only.
//
// A group of photons takes each step together: first all its rays are traced, then what can be computed side
// by side is (random numbers, and all of the commonest vertices: DiffuseLanes), then each photon leaves its
// record and goes on by itself.

#include <cmath>
#include <new>
#include <type_traits>
#include <variant>

#include "photon/tracer.h"

namespace kaustik::photon {

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

// What one photon has met, between vertices. Its ray and flux are columns of DiffuseLanes.
struct Met {
  bool specular = false, diffuse = false;

  PhotonKind kind() const {
    if (diffuse) return PhotonKind::kIndirect;
    return specular ? PhotonKind::kCaustic : PhotonKind::kDirect;
  }
};

// A photon at a vertex, for what is not computed in lanes.
struct Arrival {
  Ray ray;
  Rgb flux;
};

// The keys of a stream's Sobol sets, which all photons share: made when first asked for.
class StreamKeys {
 public:
  explicit StreamKeys(uint64_t stream) : stream_(stream) {}
  const SobolSetKeys& get(uint64_t upper_half, uint32_t set) {
    if (upper_half != upper_half_) made_ = 0;
    upper_half_ = upper_half;
    if (set >= kKept) return last_ = sobol_set_keys(stream_, upper_half, set);
    for (; made_ <= set; ++made_) keys_[made_] = sobol_set_keys(stream_, upper_half, made_);
    return keys_[set];
  }

 private:
  static constexpr uint32_t kKept = 20;
  uint64_t stream_, upper_half_ = 0;
  uint32_t made_ = 0;
  std::array<SobolSetKeys, kKept> keys_;
  SobolSetKeys last_;
};

// A triangle mesh that the hit lies on, or null.
inline const TriangleMesh* mesh_of(const Scene& scene, const Hit& hit) {
  return hit.valid() ? std::get_if<TriangleMesh>(&scene.shapes[hit.shape].geometry) : nullptr;
}

// A hit names a triangle; its vertices lie two dependent loads away, often out of cache. Asking for all of a
// group's before any is needed hides most of that wait.
inline void prefetch_indices(const Scene& scene, const Hit& hit) {
  if (const TriangleMesh* mesh = mesh_of(scene, hit)) __builtin_prefetch(&mesh->indices[hit.primitive]);
}
inline void prefetch_vertices(const Scene& scene, const Hit& hit) {
  const TriangleMesh* mesh = mesh_of(scene, hit);
  if (!mesh) return;
  for (uint32_t vertex : mesh->indices[hit.primitive]) {
    __builtin_prefetch(&mesh->P[vertex]);
    if (!mesh->N.empty()) __builtin_prefetch(&mesh->N[vertex]);
  }
}

// Walks one group after the other.
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
        keys_(photon_stream(settings)) {}

  // Photons first .. first + count - 1, at most kGroupSize, whose indices agree in their upper halves.
  void trace_group(uint64_t first, size_t count) {
    if (settings_.max_bounces < 1) {
      counters_.emitted += count;
      return;
    }
    size_t alive = start(first, count);
    for (int vertex = 1; alive > 0; ++vertex) {
      follow_rays(alive);
      const bool last = vertex >= settings_.max_bounces;
      const bool all_in_lanes = fill_lanes(alive);
      if (!last) {
        // Diffuse reflection does without the fourth number.
        draw(first >> 32, kFirstVertexSet + static_cast<uint32_t>(vertex - 1), alive, all_in_lanes ? 3 : 4,
             numbers_);
      }
      locate_lanes(lanes_, alive);
      if (settings_.kinds.indirect && !last) scatter_lanes(lanes_, numbers_, alive);
      for (size_t k = 0; k < alive; ++k) goes_on_[k] = arrive(k, last);
      alive = close_ranks(alive);
    }
  }

 private:
  // Those that go on move up, to the segments that they go on along; returns how many they are. All are moved
  // and some counted: nobody could predict a branch on that.
  size_t close_ranks(size_t alive) {
    size_t going_on = 0;
    for (size_t k = 0; k < alive; ++k) {
      lanes_.move(k, going_on);
      reversed_indices_[going_on] = reversed_indices_[k];
      met_[going_on] = met_[k];
      going_on += goes_on_[k];
    }
    return going_on;
  }

  static constexpr uint32_t kFirstVertexSet = kEmissionDimensions / 4;
  static_assert(kVertexDimensions == 4 && kEmissionDimensions % 4 == 0, "a vertex has one Sobol set");

  // From one Sobol set for the first `count` walks.
  void draw(uint64_t upper_half, uint32_t set, size_t count, int dimensions, SobolLanes& numbers) {
    draw_sobol_lanes(keys_.get(upper_half, set), reversed_indices_.data(), count, dimensions, &numbers);
  }

  // Emits; returns how many have something to carry.
  size_t start(uint64_t first, size_t count) {
    counters_.emitted += count;
    for (size_t k = 0; k < count; ++k) reversed_indices_[k] = reverse_bits(static_cast<uint32_t>(first + k));
    SobolLanes lamp;
    draw(first >> 32, 0, count, 4, numbers_);
    if (scene_.lights.size() > 1) draw(first >> 32, 1, count, 3, lamp);
    size_t alive = 0;
    for (size_t k = 0; k < count; ++k) {
      const auto& u = numbers_.u;
      const float u_lamp = scene_.lights.size() > 1 ? lamp.u[0][k] : 0;
      const auto sample = emit_photon(scene_, {{u[0][k], u[1][k]}, {u[2][k], u[3][k]}, u_lamp},
                                      settings_.photons, settings_.emission);
      if (!sample || is_black(sample->flux) || !valid(sample->flux)) continue;
      reversed_indices_[alive] = reversed_indices_[k];
      lanes_.set_segment(alive, sample->ray, sample->flux);
      met_[alive++] = {};
    }
    return alive;
  }

  void follow_rays(size_t alive) {
    counters_.rays += alive;
    // Rays are laid down well before they are read, and hits made in place: wide reads of what narrow writes
    // have just left wait until those are through.
    for (size_t k = 0; k < alive; ++k) rays_[k] = ray(k);
    for (size_t k = 0; k < alive; ++k) {
      ::new (&hits_[k]) Hit(bvh_.intersect(rays_[k]));
      prefetch_indices(scene_, hits_[k]);
    }
    for (size_t k = 0; k < alive; ++k) prefetch_vertices(scene_, hits_[k]);
  }

  // Hands the vertices that lanes_ can hold over to it and marks them in in_lanes_; true when it can hold
  // all.
  bool fill_lanes(size_t alive) {
    bool all = true;
    for (size_t k = 0; k < alive; ++k) {
      const Hit& hit = hits_[k];
      in_lanes_[k] = false;
      if (!hit.valid()) continue;
      const Shape& shape = scene_.shapes[hit.shape];
      const auto* mesh = std::get_if<TriangleMesh>(&shape.geometry);
      const auto* bsdf = std::get_if<Lambertian>(&scene_.materials[shape.material]);
      in_lanes_[k] = mesh && bsdf && mesh->N.empty();
      all &= in_lanes_[k];
      if (!in_lanes_[k]) continue;
      lanes_.set_vertex(k, *mesh, shape.flip_normal, hit, bsdf->reflectance);
    }
    return all;
  }

  // Photon k at its vertex: deposit, then scatter into next_*. False when its life ends here.
  bool arrive(size_t k, bool last) {
    if (!hits_[k].valid()) return false;
    if (in_lanes_[k] && !leaves_shadows(k)) return leave_photon_of_lane(k) && !last && survives_in_lane(k);
    const Arrival photon{rays_[k], DiffuseLanes::get(lanes_.flux, k)};
    const SurfaceInteraction si = make_interaction(scene_.shapes, photon.ray, hits_[k]);
    return std::visit(
        [&]<class B>(const B& bsdf) {
          return (B::kSpecular ? meet_specular(k) : leave_photon(k, si, photon)) && !last &&
                 scatter(k, bsdf, si, photon);
        },
        scene_.bsdf(si));
  }

  Ray ray(size_t k) const { return {DiffuseLanes::get(lanes_.o, k), DiffuseLanes::get(lanes_.d, k)}; }
  bool leaves_shadows(size_t k) const {
    return settings_.kinds.shadow && met_[k].kind() == PhotonKind::kDirect;
  }

  // leave_photon() for what lanes_ has computed. The flux was found valid when it was made.
  bool leave_photon_of_lane(size_t k) {
    const PhotonKind kind = met_[k].kind();
    if (settings_.kinds[kind] && lanes_.cos_in[k] != 0) {
      ++counters_.stored[static_cast<size_t>(kind)];
      sink_(kind, Photon{DiffuseLanes::get(lanes_.p, k), -DiffuseLanes::get(lanes_.d, k),
                         DiffuseLanes::get(lanes_.flux, k), DiffuseLanes::get(lanes_.facing, k),
                         scene_.shapes[hits_[k].shape].surface_group});
    }
    met_[k].diffuse = true;
    return settings_.kinds.indirect;
  }

  bool survives_in_lane(size_t k) {
    counters_.dropped_invalid += lanes_.fate[k] == DiffuseLanes::kInvalid;
    return lanes_.fate[k] == DiffuseLanes::kAlive;
  }

  // Counts and refuses what must never reach a map.
  bool valid(const Rgb& flux) {
    if (is_valid_flux(flux)) return true;
    ++counters_.dropped_invalid;
    return false;
  }

  void record(PhotonKind kind, const SurfaceInteraction& si, const Arrival& photon) {
    const Vector3 wi = -photon.ray.d;
    const Rgb deposit = shading_correction(si, wi, glm::dot(wi, si.ns)) * photon.flux;
    if (is_black(deposit) || !valid(deposit)) return;
    ++counters_.stored[static_cast<size_t>(kind)];
    sink_(kind, Photon{si.p, wi, deposit, glm::dot(wi, si.n) < 0 ? -si.n : si.n, si.surface_group});
  }

  // The straight ray behind the first surface.
  void leave_shadows(SurfaceInteraction si, const Arrival& photon) {
    for (int i = 0; i < kMaxStraightSurfaces; ++i) {
      ++counters_.shadow_rays;
      const Ray ray = si.spawn(photon.ray.d);
      const Hit hit = bvh_.intersect(ray);
      if (!hit.valid()) return;
      si = make_interaction(scene_.shapes, ray, hit);
      if (!is_specular(scene_.bsdf(si))) record(PhotonKind::kShadow, si, photon);
    }
  }

  // At a vertex of either sort: false when nothing that is asked for can follow.
  bool meet_specular(size_t k) {
    met_[k].specular = true;
    return settings_.kinds.caustic || settings_.kinds.indirect;
  }
  bool leave_photon(size_t k, const SurfaceInteraction& si, const Arrival& photon) {
    const PhotonKind kind = met_[k].kind();
    if (settings_.kinds[kind]) record(kind, si, photon);
    if (leaves_shadows(k)) leave_shadows(si, photon);
    met_[k].diffuse = true;
    return settings_.kinds.indirect;
  }

  // Samples the next direction and plays Russian roulette; false when the photon is absorbed. Numbers of the
  // vertex: direction (0, 1), then lobe and roulette. A delta lobe needs no direction, and lobes that need no
  // choice none for it.
  template <class B>
  bool scatter(size_t k, const B& bsdf, const SurfaceInteraction& si, const Arrival& photon) {
    const auto u = [&](int dimension) { return numbers_.u[dimension][k]; };
    const Frame frame = Frame::from_z(si.ns);
    const Vector3 wo = -photon.ray.d;
    const Vector3 wo_local = frame.to_local(wo);
    const auto sample =
        bsdf.sample_f(wo_local, kChoosesLobe<B> ? u(2) : 0, {u(0), u(1)}, TransportMode::kImportance);
    if (!sample) return false;
    const Vector3 wi = unit(frame.to_world(sample->wi));
    const float c_out = shading_correction(si, wi, sample->wi.z);
    if (c_out == 0) return false;
    const Rgb next = sample->weight * (shading_correction(si, wo, wo_local.z) / c_out) * photon.flux;
    if (is_black(next) || !valid(next)) return false;
    const float scale = roulette(photon.flux, next, u(kChoosesLobe<B> ? 3 : 2));
    if (scale == 0) return false;
    DiffuseLanes::set(lanes_.next_o, k, si.spawn(wi).o);
    DiffuseLanes::set(lanes_.next_d, k, wi);
    DiffuseLanes::set(lanes_.next_flux, k, scale * next);
    return true;
  }

  // Roulette: survival with probability q = min(1, next / flux) keeps the flux of the survivors near
  // constant. Returns what to scale next by, zero for the absorbed.
  static float roulette(const Rgb& flux, const Rgb& next, float u) {
    const float before = max_component(flux), after = max_component(next);
    if (!(after < before)) return 1;
    return u * before < after ? before / after : 0.0f;
  }

  const Scene& scene_;
  const Accel& bvh_;
  const TraceSettings& settings_;
  Sink& sink_;
  TraceCounters& counters_;
  StreamKeys keys_;
  // Of the group, step by step. Lanes nobody has set are zero, not leftovers of the stack: slow denormals.
  std::array<uint32_t, kGroupSize> reversed_indices_{};  // lower halves of the photons' indices
  std::array<Met, kGroupSize> met_;
  std::array<Ray, kGroupSize> rays_;
  std::array<Hit, kGroupSize> hits_;
  std::array<bool, kGroupSize> in_lanes_{}, goes_on_{};
  SobolLanes numbers_{};
  DiffuseLanes lanes_{};
};

}  // namespace detail

template <class Accel, class Sink>
void trace_photons(const Scene& scene, const Accel& bvh, const TraceSettings& settings, uint64_t first,
                   uint64_t end, Sink&& sink, TraceCounters& counters) {
  detail::Tracer<Accel, std::remove_reference_t<Sink>> tracer(scene, bvh, settings, sink, counters);
  constexpr uint64_t kHalf = uint64_t{1} << 32;
  while (first < end) {
    const uint64_t same_upper_half = kHalf - first % kHalf;
    const uint64_t count = std::min({kGroupSize, end - first, same_upper_half});
    tracer.trace_group(first, static_cast<size_t>(count));
    first += count;
  }
}

}  // namespace kaustik::photon
