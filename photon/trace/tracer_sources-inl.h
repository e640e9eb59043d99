#pragma once
// What photons carry of the sources of light that they divide with paths (photon/sources/source_split.h).
// Included by tracer-inl.h only.

namespace kaustik::photon::detail {

template <class Accel, class Sink>
void Tracer<Accel, Sink>::choose_carriers(size_t count) {
  for (size_t k = 0; k < count; ++k) {
    if (!starts_.emitted[k]) continue;
    const uint32_t light = light_of_photon(scene_, starts_.u_light[k], settings_.light).light;
    const Ray start = starts_.ray.get(k);
    const float share = settings_.split->of_light(light, {start.o, -start.d});
    walkers_.state[k] = walkers_.state[k].carrier(number_of(k, kLightShareDimension) < share);
  }
}

template <class Accel, class Sink>
template <class B>
void Tracer<Accel, Sink>::choose_carrier(size_t k, const B& bsdf, const GlossyVertex& v) {
  if constexpr (requires { bsdf.disperses; })
    if (bsdf.disperses) return;
  const auto start = start_of(scene_, Sampler(stream_, index_of(k)), settings_.guide);
  const uint32_t light = light_of_photon(scene_, numbers_of(start.u).light, settings_.light).light;
  const float L = radiance_of_glossy(scene_, light, bsdf, v);
  if (std::isinf(L)) return;
  if constexpr (requires { sink_.meet_source(uint64_t{0}, L); }) sink_.meet_source(index_of(k), L);
  if (!settings_.split) return;
  const bool carries = number_of(k, kLightShareDimension) < settings_.split->share_of(L);
  walkers_.state[k] = walkers_.state[k].carrier(carries);
}

template <class Accel, class Sink>
bool Tracer<Accel, Sink>::knows_sources() const {
  if constexpr (requires { sink_.meet_source(uint64_t{0}, 0.0f); }) return true;
  return settings_.split != nullptr;
}

template <class Accel, class Sink>
bool Tracer<Accel, Sink>::carries_on(size_t k, const Point3& p, const Normal3& n, bool both_sides) const {
  const PhotonKind kind = walkers_.state[k].kind();
  if (!settings_.split || !settings_.split_indirect || kind == PhotonKind::kIndirect) return true;
  const bool of_photons =
      (kind == PhotonKind::kCaustic && walkers_.state[k].is_carrier()) ||
      number_of(k, kSurfaceShareDimension) < settings_.split->of_surface(p, n, both_sides);
  return of_photons != settings_.of_paths;
}

}  // namespace kaustik::photon::detail
