#pragma once
// Photons in media: what they leave there, where they are scattered, and what arrives behind. Included by
// tracer-inl.h only.

#include "core/medium/free_path.h"
#include "core/medium/phase_function.h"

namespace kaustik::photon::detail {

template <class Accel, class Sink>
void Tracer<Accel, Sink>::enter_media(size_t count) {
  for (size_t k = 0; k < count; ++k) {
    if (!starts_.emitted[k]) continue;
    const uint32_t light = light_of_photon(scene_, starts_.u_light[k], settings_.light).light;
    const Ray ray = starts_.ray.get(k);
    MediumIndex medium = accel::medium_at_start(scene_, bvh_, light, ray);
    walkers_.state[k] = WalkState().in(medium);
    if (bounds_of(scene_.lights[light])) continue;
    const Rgb left = accel::transmittance(scene_, interfaces_, {ray.o, -ray.d}, kInfinity, &medium);
    set_lane(starts_.flux, k, left * get_lane(starts_.flux, k));
  }
}

template <class Accel, class Sink>
void Tracer<Accel, Sink>::pass_media(size_t count) {
  for (size_t k = 0; k < count; ++k) {
    if (walkers_.state[k].medium() == kVacuum && !interfaces_) continue;
    const float distance = lanes_.hit.valid(k) ? lanes_.hit.t[k] : kInfinity;
    walkers_.state[k].is_straight() ? attenuate(k, distance) : go_through_media(k, distance);
  }
}

template <class Accel, class Sink>
void Tracer<Accel, Sink>::attenuate(size_t k, float distance) {
  MediumIndex medium = walkers_.state[k].medium();
  const Rgb left = accel::transmittance(scene_, interfaces_, lanes_.ray.get(k), distance, &medium);
  walkers_.state[k] = walkers_.state[k].in(medium);
  set_lane(lanes_.flux, k, left * get_lane(lanes_.flux, k));
}

template <class Accel, class Sink>
void Tracer<Accel, Sink>::go_through_media(size_t k, float distance) {
  const Rgb flux = get_lane(lanes_.flux, k);
  const Ray ray = lanes_.ray.get(k);
  const WalkState state = walkers_.state[k];
  const bool leaves = settings_.kinds.medium_caustic && state.kind() == PhotonKind::kCaustic;
  FreePath way(flux, {medium_numbers_.u[0][k], medium_numbers_.u[1][k]});
  Rgb clear(1);  // what gets through, for photons that are left on the way
  std::optional<float> scattered;
  MediumIndex scattering = kVacuum;
  const auto part = [&](MediumIndex m, float begin, float end) {
    const Medium& medium = scene_.media[m];
    const float column = column_of(medium, ray, begin, end);
    if (leaves) leave_caustic_on_the_way(k, {m, begin, end}, column, clear * flux);
    clear *= transmittance(medium, column);
    if (!follows_indirect_ || scattered) return true;
    const std::optional<float> passed = way.pass(medium, column);
    if (!passed) return true;
    scattered = place_of(*passed, medium, ray, begin, end);
    scattering = m;
    return leaves;  // where the photon itself is scattered does not matter to a caustic
  };
  const MediumIndex end = accel::walk_media(interfaces_, ray, distance, state.medium(), part);
  if (scattered) {
    const Rgb left = way.scattered(scene_.media[scattering]) * flux;
    scatter_in_medium(k, scattering, ray.at(*scattered), left, way.rest());
    return end_before_hit(k);
  }
  walkers_.state[k] = state.in(end);
  arrive_behind_media(k, (follows_indirect_ ? way.passed() : clear) * flux);
}

template <class Accel, class Sink>
void Tracer<Accel, Sink>::arrive_behind_media(size_t k, const Rgb& flux) {
  set_lane(lanes_.flux, k, flux);
  const int32_t energy = energy_of(flux, units_per_watt_);
  counters_.energy.in_media += walkers_.energy[k] - energy;
  walkers_.energy[k] = energy;
}

template <class Accel, class Sink>
void Tracer<Accel, Sink>::leave_caustic_on_the_way(size_t k, const MediumPart& part, float column,
                                                   const Rgb& flux) {
  const Medium& medium = scene_.media[part.medium];
  if (!medium.scatters()) return;
  const ScatteringPlace place(medium, flux, column);
  if (!(place.opacity() > 0)) return;
  const Ray ray = lanes_.ray.get(k);
  const auto parts = static_cast<float>(settings_.photons_on_segments);
  for (uint32_t i = 0; i < settings_.photons_on_segments; ++i) {
    const float u = std::min((static_cast<float>(i) + medium_numbers_.u[1][k]) / parts, kOneMinusEpsilon);
    const float passed = place.sample({medium_numbers_.u[0][k], u}), density = parts * place.pdf(passed);
    if (!(density > 0)) continue;
    leave_in_medium(k, PhotonKind::kMediumCaustic, part.medium,
                    ray.at(place_of(passed, medium, ray, part.begin, part.end)),
                    place.scattered(passed) / density * flux);
  }
}

template <class Accel, class Sink>
void Tracer<Accel, Sink>::leave_in_medium(size_t k, PhotonKind kind, MediumIndex medium, const Point3& p,
                                          const Rgb& scattered) {
  if (is_black(scattered) || !valid(scattered)) return;
  ++counters_.stored[static_cast<size_t>(kind)];
  const Vector3 wi = -get_lane(lanes_.ray.d, k);
  hand_over(k, kind, Photon{p, wi, scattered, wi, medium});
}

template <class Accel, class Sink>
void Tracer<Accel, Sink>::scatter_in_medium(size_t k, MediumIndex m, const Point3& p, const Rgb& flux,
                                            float u_roulette) {
  WalkState& state = walkers_.state[k];
  if (settings_.kinds.medium_indirect && state.kind() == PhotonKind::kIndirect)
    leave_in_medium(k, PhotonKind::kMediumIndirect, m, p, flux);
  const float scale = roulette(get_lane(lanes_.flux, k), flux, u_roulette);
  arrive_behind_media(k, flux);
  state = state.in(m);
  go_on_in_medium(k, scene_.media[m].g, p, scale);
}

template <class Accel, class Sink>
void Tracer<Accel, Sink>::go_on_in_medium(size_t k, float g, const Point3& p, float scale) {
  const Rgb arrived = get_lane(lanes_.flux, k);
  if (is_last(k) || is_black(arrived) || !valid(arrived)) {
    counters_.energy.terminated += walkers_.energy[k];
    return;
  }
  const Rgb flux = scale * arrived;
  const int32_t energy = energy_of(flux, units_per_watt_);
  counters_.energy.roulette += walkers_.energy[k] - energy;
  if (scale == 0) return;
  const Point2 u(medium_numbers_.u[2][k], medium_numbers_.u[3][k]);
  const Vector3 d = unit(sample_phase(get_lane(lanes_.ray.d, k), g, u));
  queue_of(d).push(p, d, flux, walkers_.reversed_index[k], walkers_.state[k].behind_diffuse(), energy);
}

template <class Accel, class Sink>
void Tracer<Accel, Sink>::end_before_hit(size_t k) {
  lanes_.hit.set(k, Hit{});
  set_lane(lanes_.flux, k, Rgb(0));
  walkers_.energy[k] = 0;
}

}  // namespace kaustik::photon::detail
