#pragma once
// Implementation of trace_photons(). Included by tracer.h only.
//
// Photons wait in eight queues, one for each octant of ray directions. A group from one queue takes a step
// together: its rays are traced in packets; random numbers and the commonest kinds of vertices are computed
// in SIMD lanes (VertexLanes), all others one by one; each vertex leaves its record; and the photons that
// continue join the queues again. New photons are emitted only when no queue holds a whole group, so that
// packets stay full of similar rays until the last photons have been emitted.

#include <cmath>
#include <memory>
#include <type_traits>
#include <variant>

#include "accel/media_walk.h"
#include "core/scene/bsdf_at.h"
#include "photon/trace/glossy_source.h"
#include "photon/trace/lanes/intersect_lanes.h"
#include "photon/trace/lanes/walker_queue.h"
#include "photon/trace/shading_correction.h"
#include "photon/trace/tracer.h"

namespace kaustik::photon {

namespace detail {

// One Newton step towards length 1, for directions whose length is off by rounding only. It keeps long
// specular chains from drifting and needs no division.
inline Vector3 unit(const Vector3& w) {
  return (1.5f - 0.5f * length_squared(w)) * w;
}

// A photon that arrives at a vertex which is not computed in lanes.
struct Arrival {
  Ray ray;
  Rgb flux;
};

// Traces photons whose 64-bit indices have the same upper half.
template <class Accel, class Sink>
class Tracer {
 public:
  Tracer(const Scene& scene, const SurfaceTable& surfaces, const Accel& bvh, const TraceSettings& settings,
         uint64_t upper_half, Sink& sink, TraceCounters& counters)
      : scene_(scene),
        surfaces_(surfaces),
        bvh_(bvh),
        settings_(settings),
        sink_(sink),
        counters_(counters),
        unit_exponent_(energy_unit_exponent(scene, settings.photons)),
        keys_(photon_stream(settings), upper_half) {
    counters_.energy.unit_exponent = unit_exponent_;
  }

  void trace(uint64_t first, uint64_t end) {
    if (settings_.max_bounces < 1) {
      counters_.emitted += end - first;
      return;
    }
    for (;;) {
      WalkerQueue& queue = fullest();
      if (queue.size() >= kGroupSize) {
        step(queue, kGroupSize);
      } else if (first < end) {
        const uint64_t count = std::min(kGroupSize, end - first);
        emit(first, static_cast<size_t>(count));
        first += count;
      } else if (queue.size() > 0) {
        step(queue, queue.size());
      } else {
        return;
      }
    }
  }

 private:
  static constexpr uint32_t kFirstVertexSet = kEmissionDimensions / 4;
  static_assert(kVertexDimensions == 4 && kEmissionDimensions % 4 == 0, "a vertex has one Sobol set");
  static constexpr uint8_t kNothing = kPhotonKinds;  // value of left_: the vertex leaves no photon

  WalkerQueue& fullest() {
    WalkerQueue* best = &queues_[0];
    for (WalkerQueue* q = best + 1; q < &queues_[8]; ++q) best = q->size() > best->size() ? q : best;
    return *best;
  }
  WalkerQueue& queue_of(const Vector3& d) { return queues_[WalkerQueue::octant(d)]; }

  // Draws the numbers of one Sobol set for the first `count` lanes.
  void draw_from(uint32_t set, size_t count, int dimensions, SobolLanes& numbers) {
    sets_.fill(set);
    keys_.make(set);
    draw_sobol_lanes(keys_, sets_.data(), walkers_.reversed_index, count, dimensions, &numbers);
  }

  void emit(uint64_t first, size_t count) {
    counters_.emitted += count;
    for (size_t k = 0; k < count; ++k)
      walkers_.reversed_index[k] = reverse_bits(static_cast<uint32_t>(first + k));
    if (scene_.lights.size() > 1 && !settings_.light) {
      draw_from(1, count, 3, numbers_);
      std::copy_n(numbers_.u[0], count, starts_.u_light);
    }
    draw_from(0, count, 4, starts_.position_direction);
    if (settings_.guide) settings_.guide->warp(starts_, count, weights_);
    emit_lanes(scene_, settings_.photons, settings_.emission, count, starts_, settings_.light);
    if (settings_.guide) weigh_starts(count);
    std::fill_n(walkers_.state, count, WalkState());
    if (!scene_.light_media.empty()) enter_media(count);
    if (settings_.split) choose_carriers(count);
    to_energy_lanes(starts_.flux, count, units_per_watt_, walkers_.energy);
    for (size_t k = 0; k < count; ++k) {
      const Rgb flux = get_lane(starts_.flux, k);
      goes_on_[k] = starts_.emitted[k] && !is_black(flux) && valid(flux) && !sky_hidden(bvh_, starts_, k);
      if (goes_on_[k]) counters_.energy.emitted += walkers_.energy[k];
    }
    push(starts_.ray, starts_.flux, count);
  }

  // Sources of light that photons and paths divide: photon/trace/tracer_sources-inl.h.
  // Draws which photons carry what their lights send through specular surfaces.
  void choose_carriers(size_t count);
  // The same for light that meets a glossy surface first, of which paths find some although no ray can hit
  // the light.
  template <class B>
  void choose_carrier(size_t k, const B& bsdf, const GlossyVertex& v);
  // Whether the sources of light matter.
  bool knows_sources() const;
  // Whether the photon carries on what diffuse lobes at p scatter of it. n: normal on the side of the photon.
  bool carries_on(size_t k, const Point3& p, const Normal3& n, bool both_sides) const;
  float number_of(size_t k, uint32_t dimension) const {
    return Sampler(stream_, index_of(k), dimension).next_1d();
  }
  // Whether the photon leaves a record of this kind at p. n, both_sides: as for carries_on().
  bool leaves(size_t k, PhotonKind kind, const Point3& p, const Normal3& n, bool both_sides) const {
    if (!settings_.kinds[kind]) return false;
    if (!settings_.split || kind != PhotonKind::kCaustic) return true;
    if (settings_.of_paths) return carries_on(k, p, n, both_sides);
    return !settings_.split_caustics || walkers_.state[k].is_carrier();
  }
  // The kind of the records that photons of this kind leave.
  PhotonKind left_as(PhotonKind kind) const { return settings_.of_paths ? PhotonKind::kIndirect : kind; }

  void weigh_starts(size_t count) {
    for (auto& channel : starts_.flux)
      for (size_t k = 0; k < count; ++k) channel[k] *= weights_[k];
  }

  // Pushes the photons whose goes_on_ is set into the queues.
  void push(const accel::RayLanes& rays, const LaneColumn (&flux)[3], size_t count) {
    to_rows(rays, flux, walkers_, count, &rows_);
    for (size_t k = 0; k < count; ++k) queues_[rows_.octant[k]].push(rows_, k, goes_on_[k]);
  }

  void step(WalkerQueue& queue, size_t count) {
    queue.take(count, lanes_, walkers_);
    intersect_lanes(bvh_, lanes_.ray, count, &lanes_.hit);
    if (surfaces_.many_triangles()) prefetch_triangles(surfaces_, lanes_.hit, count);
    if (scene_.needs.scattering) draw_medium_numbers(count);
    if (scene_.needs.media) pass_media(count);
    const uint32_t traits = fill_lanes(count);
    locate_lanes(lanes_, surfaces_.shapes(), count);
    const bool chooses_lobes = traits & (kSpecularTrait | kScalarTrait);
    if (follows_indirect_ || (follows_caustics_ && chooses_lobes)) {
      // Diffuse reflection does not need the fourth number.
      draw_vertex_numbers(count, chooses_lobes ? 4 : 3);
      scatter_lanes(lanes_, numbers_, units_per_watt_, count);
    }
    const uint64_t dropped_before = counters_.dropped_invalid;
    for (size_t k = 0; k < count; ++k) arrive(k);
    leave_photons_of_lanes(count);
    if (counters_.dropped_invalid != dropped_before) book_dropped(count);
    book(count);
    push(lanes_.next, lanes_.next_flux, count);
  }

  // Media: photon/trace/tracer_media-inl.h.
  // Sets the media in which the first `count` photons start. Light from infinitely far has come through them
  // already.
  void enter_media(size_t count);
  // Takes the photons through the media between them and their hits.
  void pass_media(size_t count);
  // Straight rays are not scattered.
  void attenuate(size_t k, float distance);
  // Takes a photon to its hit, or to where a medium scatters it.
  void go_through_media(size_t k, float distance);
  // Sets the flux that arrives; the rest stays in the media.
  void arrive_behind_media(size_t k, const Rgb& flux);
  // A part of a walker's ray that lies in one medium, metres from its start.
  struct MediumPart {
    MediumIndex medium;
    float begin, end;
  };
  // A caustic leaves photons on each of its segments in a medium, however thin the medium is. column: the
  // segment's column density; flux: at its beginning.
  void leave_caustic_on_the_way(size_t k, const MediumPart& part, float column, const Rgb& flux);
  void leave_in_medium(size_t k, PhotonKind kind, MediumIndex medium, const Point3& p, const Rgb& scattered);
  // flux: what the medium scatters at p.
  void scatter_in_medium(size_t k, MediumIndex m, const Point3& p, const Rgb& flux, float u_roulette);
  // Queues what goes on from a point in a medium. scale: what Russian roulette makes of the flux, or zero.
  void go_on_in_medium(size_t k, float g, const Point3& p, float scale);
  // Makes a segment that ends in a medium one that meets nothing and carries nothing.
  void end_before_hit(size_t k);

  // Sobol sets of a vertex; where media scatter, each is followed by one for the medium before the vertex.
  uint32_t vertex_set(size_t k) const {
    // Straight rays use no random numbers, so any set will do for them.
    const uint32_t rays = walkers_.state[k].is_straight() ? 0 : walkers_.state[k].rays();
    return kFirstVertexSet + (scene_.needs.scattering ? 2 * rays : rays);
  }

  void draw_medium_numbers(size_t count) { draw_numbers(count, 4, 1, &medium_numbers_); }
  void draw_vertex_numbers(size_t count, int dimensions) { draw_numbers(count, dimensions, 0, &numbers_); }

  // Draws the numbers of the sets `after` the photons' vertex sets.
  void draw_numbers(size_t count, int dimensions, uint32_t after, SobolLanes* numbers) {
    uint32_t last = 0;
    for (size_t k = 0; k < count; ++k) {
      sets_[k] = vertex_set(k) + after;
      last = std::max(last, sets_[k]);
    }
    std::fill(sets_.begin() + static_cast<std::ptrdiff_t>(count), sets_.end(), kFirstVertexSet);
    keys_.make(last);
    draw_sobol_lanes(keys_, sets_.data(), walkers_.reversed_index, count, dimensions, numbers);
  }

  // Copies each hit's surface to lanes_; returns all traits of these surfaces combined.
  uint32_t fill_lanes(size_t count) {
    uint32_t traits = 0;
    for (size_t k = 0; k < count; ++k) {
      const SurfaceRow& surface = surfaces_.row(lanes_.hit.shape[k]);
      lanes_.set_vertex(k, surface);
      traits |= surface.traits;
    }
    return traits;
  }

  // Books the energy of the group's first `count` lanes; the other lanes are cleared.
  void book(size_t count) {
    std::fill(walkers_.energy + count, walkers_.energy + kGroupSize, 0);
    std::fill(scatters_ + count, scatters_ + kGroupSize, uint8_t{0});
    book_lanes(lanes_, scatters_, walkers_, counters_.energy);
  }
  void book_dropped(size_t count) {
    for (size_t k = 0; k < count; ++k) {
      if (!scatters_[k] || lanes_.fate[k] != VertexLanes::kInvalid) continue;
      counters_.energy.invalid += walkers_.energy[k];
      walkers_.energy[k] = scatters_[k] = 0;
    }
  }

  // Treats photon k at its vertex: what it leaves (left_), whether it continues (goes_on_), its state
  // (walkers_) and its next segment (lanes_).
  void arrive(size_t k) {
    ++(walkers_.state[k].is_straight() ? counters_.shadow_rays : counters_.rays);
    if (lanes_.traits[k] & kScalarTrait) return arrive_alone(k);
    const WalkState before = walkers_.state[k];
    arrive_in_lane(k);
    if (settings_.kinds.shadow && lanes_.hit.valid(k)) cast_shadow(k, before);
  }

  // Not inlined, because arrive() is inlined into the loop over the lanes and most lanes do not come here.
  [[gnu::noinline]] void arrive_alone(size_t k) {
    left_[k] = kNothing;
    goes_on_[k] = false;
    scatters_[k] = false;
    const Arrival photon{lanes_.ray.get(k), get_lane(lanes_.flux, k)};
    SurfaceInteraction si = make_interaction(scene_.shapes, photon.ray, lanes_.hit.get(k));
    const bool may_disperse = scene_.needs.dispersion && !scene_.materials[si.material].constant();
    const BsdfAt bsdf_at(scene_, si, -photon.ray.d, {}, may_disperse ? wavelength_of(k) : kNoWavelength);
    std::visit(
        [&](const auto& bsdf) {
          const Lobes lobes = bsdf.lobes();
          using B = std::remove_cvref_t<decltype(bsdf)>;
          const bool glossy = settings_.under_glossy && !B::kTransmits && lobes.glossy &&
                              walkers_.state[k].kind() == PhotonKind::kCaustic;
          const bool gathers = lobes.diffuse || scene_.materials[si.material].lobes().diffuse || glossy;
          leave_photon(k, si, photon, !gathers, B::kTransmits);
          if (walkers_.state[k].is_straight()) return go_straight_on(k, si.spawn(photon.ray.d), photon.flux);
          const bool wanted = follows_indirect_ || (lobes.specular && follows_caustics_);
          if (wanted && !is_last(k)) scatter_alone(k, bsdf, si, photon);
        },
        *bsdf_at);
  }

  // Does what arrive_alone() does for a vertex that was computed in lanes, except for shadow photons. The
  // flux was found valid when it was made. Branchless: outcomes depend on the data and would be mispredicted.
  void arrive_in_lane(size_t k) {
    const bool met = !(lanes_.traits[k] & kMissedTrait), specular = lanes_.traits[k] & kSpecularTrait;
    const PhotonKind kind = walkers_.state[k].kind();
    const Point3 p = get_lane(lanes_.p, k);
    const Normal3 facing = get_lane(lanes_.facing, k);
    const bool left = met & !specular & leaves(k, kind, p, facing, false) & (lanes_.cos_in[k] != 0);
    left_[k] = left ? static_cast<uint8_t>(left_as(kind)) : kNothing;
    counters_.stored[static_cast<size_t>(left_as(kind))] += left;
    const bool wanted = follows_indirect_ | (specular & follows_caustics_);
    bool asked = met & wanted & !walkers_.state[k].is_straight() & !is_last(k);
    if (settings_.split && asked && !specular) asked = carries_on(k, p, facing, false);
    scatters_[k] = asked;
    counters_.dropped_invalid += asked & (lanes_.fate[k] == VertexLanes::kInvalid);
    goes_on_[k] = asked & (lanes_.fate[k] == VertexLanes::kAlive);
    walkers_.state[k] = specular ? walkers_.state[k].behind_specular() : walkers_.state[k].behind_diffuse();
  }

  // Starts or continues the straight ray that leaves shadow photons, at a vertex computed in lanes.
  void cast_shadow(size_t k, WalkState before) {
    const bool specular = lanes_.traits[k] & kSpecularTrait;
    if (!before.is_straight() && !casts_shadow(before.kind(), specular)) return;
    const Vector3 d = get_lane(lanes_.ray.d, k);
    const Ray on{offset_origin(get_lane(lanes_.p, k), lanes_.p_error[k], get_lane(lanes_.n, k), d), d};
    const Rgb flux = get_lane(lanes_.flux, k);
    if (!before.is_straight()) return start_straight(k, on, flux);
    walkers_.state[k] = before;
    go_straight_on(k, on, flux);
  }

  bool is_last(size_t k) const {
    return walkers_.state[k].rays() + 1 >= static_cast<uint32_t>(settings_.max_bounces);
  }

  // Queues the straight ray behind a photon's first surface.
  void start_straight(size_t k, const Ray& on, const Rgb& flux) {
    const WalkState state = WalkState::straight().in(walkers_.state[k].medium());
    queue_of(on.d).push(on.o, on.d, flux, walkers_.reversed_index[k], state);
  }
  void go_straight_on(size_t k, const Ray& on, const Rgb& flux) {
    lanes_.set_next(k, on, flux);
    walkers_.state[k] = walkers_.state[k].behind_any();
    goes_on_[k] = walkers_.state[k].rays() < kMaxStraightSurfaces;
  }

  void leave_photons_of_lanes(size_t count) {
    if constexpr (requires { sink_(lanes_, left_.data(), count); }) {
      if (!scene_.needs.dispersion) return sink_(lanes_, left_.data(), count);
    }
    for (size_t k = 0; k < count; ++k) {
      if (left_[k] == kNothing) continue;
      hand_over(k, static_cast<PhotonKind>(left_[k]),
                Photon{get_lane(lanes_.p, k), -get_lane(lanes_.ray.d, k), get_lane(lanes_.flux, k),
                       get_lane(lanes_.facing, k), lanes_.surface_group[k]});
    }
  }

  void hand_over(size_t k, PhotonKind kind, Photon photon) {
    if (walkers_.state[k].is_dispersed()) photon.wavelength = wavelength_of(k);
    if constexpr (requires { sink_(kind, photon, uint64_t{0}); }) {
      sink_(kind, photon, index_of(k));
    } else {
      sink_(kind, photon);
    }
  }

  uint64_t index_of(size_t k) const {
    return keys_.upper_half() << 32 | reverse_bits(walkers_.reversed_index[k]);
  }
  // The one wavelength that this part of the photon has once it is dispersed. Those of all parts are spread
  // evenly over the numbers from which wavelengths are made.
  float wavelength_of(size_t k) const {
    const float first = number_of(k, kWavelengthDimension);
    const float u = first + float(walkers_.state[k].part()) / float(WalkState::kParts);
    return sample_wavelength(u < 1 ? u : u - 1);
  }

  // Counts invalid fluxes, which must never reach a map.
  bool valid(const Rgb& flux) {
    if (is_valid_flux(flux)) return true;
    ++counters_.dropped_invalid;
    return false;
  }

  void leave_photon(size_t k, const SurfaceInteraction& si, const Arrival& photon, bool specular,
                    bool both_sides) {
    const PhotonKind kind = walkers_.state[k].kind();
    const Normal3 facing = glm::dot(photon.ray.d, si.n) > 0 ? -si.n : si.n;
    if (!specular && leaves(k, kind, si.p, facing, both_sides)) record(k, left_as(kind), si, photon);
    if (settings_.kinds.shadow && casts_shadow(kind, specular))
      start_straight(k, si.spawn(photon.ray.d), photon.flux);
  }

  // Whether a photon of this kind starts a straight ray behind the surface where it arrives.
  bool casts_shadow(PhotonKind kind, bool specular) const {
    return kind == PhotonKind::kDirect && (!specular || settings_.shadow_behind_specular);
  }

  void record(size_t k, PhotonKind kind, const SurfaceInteraction& si, const Arrival& photon) {
    const Vector3 wi = -photon.ray.d;
    const Rgb deposit = shading_correction(si, wi, glm::dot(wi, si.ns)) * photon.flux;
    if (is_black(deposit) || !valid(deposit)) return;
    ++counters_.stored[static_cast<size_t>(kind)];
    hand_over(k, kind, Photon{si.p, wi, deposit, glm::dot(wi, si.n) < 0 ? -si.n : si.n, si.surface_group});
  }

  template <class B>
  void scatter_alone(size_t k, const B& bsdf, const SurfaceInteraction& si, const Arrival& photon) {
    const uint64_t dropped_before = counters_.dropped_invalid;
    lanes_.scattered_energy[k] = lanes_.next_energy[k] = 0;
    scatters_[k] = true;
    goes_on_[k] = meets_prism(k, bsdf) ? divide(k, si, photon) : scatter(k, bsdf, si, photon);
    const bool dropped = counters_.dropped_invalid != dropped_before;
    lanes_.fate[k] = dropped ? VertexLanes::kInvalid : VertexLanes::kAlive;
  }

  // Whether the photon is divided here into parts of different wavelengths, which happens once.
  template <class B>
  bool meets_prism(size_t k, const B& bsdf) const {
    if constexpr (requires { bsdf.disperses; }) return bsdf.disperses && !walkers_.state[k].is_divided();
    return false;
  }

  // Dispersion: photon/trace/tracer_dispersion-inl.h.
  // Divides the photon into parts of different wavelengths. Returns whether anything goes on in lane k.
  bool divide(size_t k, const SurfaceInteraction& si, const Arrival& photon);
  // Queues what goes on from lane k at once; returns its energy.
  int32_t queue_next(size_t k);

  // Samples the next direction and plays Russian roulette. False when the photon is absorbed, or when no
  // requested kind needs what this lobe scatters. The vertex's random numbers are: direction (0 and 1), lobe
  // if B::kDrawsLobe, roulette.
  template <class B>
  bool scatter(size_t k, const B& bsdf, const SurfaceInteraction& si, const Arrival& photon) {
    const auto u = [&](int dimension) { return numbers_.u[dimension][k]; };
    const Vector3 wo = -photon.ray.d;
    const Frame frame = scatters_about_n<B>(si, wo) ? geometric_frame(si) : si.shading_frame();
    const Vector3 wo_local = frame.to_local(wo);
    const auto sample =
        bsdf.sample_f(wo_local, B::kDrawsLobe ? u(2) : 0, {u(0), u(1)}, TransportMode::kImportance);
    if (!sample) return false;
    const Normal3 facing = glm::dot(wo, si.n) < 0 ? -si.n : si.n;
    scatters_[k] = sample->specular || (follows_indirect_ && carries_on(k, si.p, facing, B::kTransmits));
    if (!scatters_[k]) return false;
    if (sample->glossy && walkers_.state[k].kind() == PhotonKind::kDirect && knows_sources())
      choose_carrier(k, bsdf, {si, wo, wo_local, sample->wi});
    WalkState& state = walkers_.state[k];
    state = sample->specular ? state.behind_specular() : state.behind_diffuse();
    if constexpr (requires { bsdf.selects_wavelength(wo_local, *sample); })
      if (bsdf.selects_wavelength(wo_local, *sample)) state = state.dispersed();
    const Onward on = onward(bsdf, si, frame, wo, wo_local, *sample);
    const Rgb next = on.weight * photon.flux;
    if (is_black(next) || !valid(next)) return false;
    lanes_.scattered_energy[k] = energy_of(next, units_per_watt_);
    const float scale = roulette(photon.flux, next, u(B::kDrawsLobe ? 3 : 2));
    if (scale == 0) return false;
    state = state.in(medium_beyond(scene_, si, wo, on.wi, state.medium()));
    lanes_.set_next(k, si.spawn(unit(on.wi)), scale * next);
    lanes_.next_energy[k] = energy_of(scale * next, units_per_watt_);
    return true;
  }

  // Russian roulette with survival probability q = min(1, next / flux), which keeps the survivors' flux
  // nearly constant. Returns the factor for `next`, zero if the photon is absorbed.
  static float roulette(const Rgb& flux, const Rgb& next, float u) {
    const float before = max_component(flux), after = max_component(next);
    if (!(after < before)) return 1;
    return u * before < after ? before / after : 0.0f;
  }

  const Scene& scene_;
  const SurfaceTable& surfaces_;
  const Accel& bvh_;
  const accel::Bvh* interfaces_ = accel::interfaces_of(bvh_);
  const TraceSettings& settings_;
  Sink& sink_;
  TraceCounters& counters_;
  // What the paths must be followed for.
  const bool follows_caustics_ = settings_.kinds.caustic || settings_.kinds.medium_caustic;
  const bool follows_indirect_ = settings_.kinds.indirect || settings_.kinds.medium_indirect;
  const uint64_t stream_ = photon_stream(settings_);
  int unit_exponent_;  // of the energy ledger
  float units_per_watt_ = std::ldexp(1.0f, -unit_exponent_);
  SobolKeyTable keys_;
  std::unique_ptr<WalkerQueue[]> queues_ = std::make_unique_for_overwrite<WalkerQueue[]>(8);
  // State of the group that takes a step. Lanes are zero-initialised, because leftovers of the stack may be
  // denormals, which are slow to compute with.
  VertexLanes lanes_{};
  SobolLanes numbers_{}, medium_numbers_{};
  EmissionLanes starts_{};
  LaneColumn weights_{};  // 1/p of guided starts
  WalkerLanes walkers_{};
  WalkerRows rows_{};
  std::array<uint32_t, kGroupSize> sets_{};  // each lane's Sobol set
  std::array<bool, kGroupSize> goes_on_{};
  // the arriving energy is booked as scattered, not as terminated
  alignas(64) uint8_t scatters_[kGroupSize]{};
  std::array<uint8_t, kGroupSize> left_{};  // kind of the photon that the lane's vertex leaves, or kNothing
};

}  // namespace detail
}  // namespace kaustik::photon

#include "photon/trace/tracer_dispersion-inl.h"
#include "photon/trace/tracer_media-inl.h"
#include "photon/trace/tracer_sources-inl.h"

namespace kaustik::photon {

template <class Accel, class Sink>
void trace_photons(const Scene& scene, const SurfaceTable& surfaces, const Accel& bvh,
                   const TraceSettings& settings, uint64_t first, uint64_t end, Sink&& sink,
                   TraceCounters& counters) {
  constexpr uint64_t kHalf = uint64_t{1} << 32;
  while (first < end) {
    const uint64_t stop = std::min(end, (first / kHalf + 1) * kHalf);
    detail::Tracer<Accel, std::remove_reference_t<Sink>> tracer(scene, surfaces, bvh, settings, first / kHalf,
                                                                sink, counters);
    tracer.trace(first, stop);
    first = stop;
  }
}

}  // namespace kaustik::photon
